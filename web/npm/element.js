// <skel-drawing src="hero.png" clip="dance" plan="auto">: a drawing that moves. Turned by mouse, finger and arrow keys;
// says `rigged` (detail: the character) or `error` (detail: what is wrong, which it shows as well). One worker and one
// WebGL context do the work of all of them.
import { SkelError } from '../src/skel.js';
import { DrawingStage } from './stage.js';
import { startWorker } from './worker.js';

const kShadow = `<style>
:host { display: inline-block; position: relative; width: 320px; height: 320px; }
canvas { width: 100%; height: 100%; display: block; }
p { position: absolute; inset: auto 0 0; margin: 0; padding: .3em .6em; background: #fdeeee; color: #a3212b; overflow-wrap: anywhere; }
p:empty { display: none; }
</style><canvas tabindex="0" role="img" part="canvas"></canvas><p role="status" part="error"></p>`;
let worker;

// On a server there are no elements: there it is imported, and nothing else.
export class SkelDrawing extends (globalThis.HTMLElement ?? class {}) {
  static observedAttributes = ['src', 'clip', 'plan'];
  #stage;
  #complaint;
  #unable; // why nothing can be shown here
  #asked = 0; // so many drawings; the last one counts

  connectedCallback() {
    const first = !this.shadowRoot || this.#unable;
    if (!this.shadowRoot) this.#build();
    this.#unable = undefined;
    try {
      this.#stage.start();
    } catch (error) {
      this.#unable = error;
      this.#complain(error);
      return;
    }
    if (first) this.#showSource();
  }

  disconnectedCallback() {
    this.#stage.stop();
  }

  #build() {
    const root = this.attachShadow({ mode: 'open' });
    root.innerHTML = kShadow;
    this.#complaint = root.querySelector('p');
    const canvas = root.querySelector('canvas');
    canvas.ariaLabel = this.getAttribute('alt') ?? '';
    canvas.addEventListener('keydown', ({ key }) => {
      if (key === 'ArrowLeft' || key === 'ArrowRight') this.#stage?.turn(key === 'ArrowLeft' ? -0.2 : 0.2);
    });
    this.#stage = new DrawingStage(canvas);
    let complained;
    this.#stage.onlost = (error) => this.#complain(complained = error);
    this.#stage.onrestored = () => {
      if (complained && this.#complaint.textContent === complained.message) this.#complaint.textContent = '';
    };
  }

  attributeChangedCallback(attribute) {
    if (!this.#stage) return;
    if (attribute === 'clip') this.#play();
    else if (this.src) this.#showSource();
    else if (attribute === 'src') this.#clear();
  }

  get src() { return this.getAttribute('src') ?? ''; }
  set src(url) { this.setAttribute('src', url); }
  get plan() { return this.getAttribute('plan') ?? 'auto'; }
  set plan(name) { this.setAttribute('plan', name); }
  get clip() { return this.getAttribute('clip') ?? 'idle'; }
  set clip(name) { this.setAttribute('clip', name); }
  get clips() { return (this.#stage?.clips ?? []).map(({ name }) => name); }

  // A drawing given as bytes, Blob or File, as rig() takes it. Resolves to the character, or to undefined where another
  // drawing was asked for since; rejects with what `error` says.
  show(drawing, options = {}) {
    return this.#show(async () => [drawing, options]);
  }

  #showSource() {
    const { src } = this;
    if (!src) return;
    this.#show(async () => {
      const answer = await fetch(src).catch(({ message }) => { throw new SkelError(`${src}: cannot be loaded (${message})`); });
      if (!answer.ok) throw new SkelError(`${src}: ${answer.status} ${answer.statusText}`.trim());
      return [await answer.blob(), { name: src.split(/[?#]/)[0].split('/').pop() || 'drawing.png' }];
    }).catch(() => {}); // it has been said
  }

  // `take()`: [drawing, options].
  async #show(take) {
    const mine = ++this.#asked;
    try {
      if (!this.#stage) throw new SkelError('<skel-drawing>: has not been in a page yet');
      if (this.#unable) throw this.#unable;
      const [drawing, options] = await take();
      worker ??= startWorker();
      const character = await worker.rig(drawing, { plan: this.plan, ...options });
      if (mine !== this.#asked) return undefined;
      await this.#stage.show(character.glb);
      if (mine !== this.#asked) return undefined;
      this.#play();
      this.dispatchEvent(new CustomEvent('rigged', { detail: character }));
      return character;
    } catch (error) {
      if (mine !== this.#asked) return undefined;
      this.#complain(error);
      throw error;
    }
  }

  #clear() {
    ++this.#asked;
    this.#stage.clear();
    this.#complaint.textContent = '';
  }

  #play() {
    const { clip, clips } = this;
    this.#stage.play(clip);
    this.#complaint.textContent = '';
    if (clip && clips.length && !clips.includes(clip)) this.#complain(new SkelError(`clip: there is no "${clip}"; there are ${clips.join(', ')}`));
  }

  #complain(error) {
    if (this.#complaint) this.#complaint.textContent = error.message;
    this.dispatchEvent(new CustomEvent('error', { detail: error }));
  }
}

if (globalThis.customElements && !customElements.get('skel-drawing')) customElements.define('skel-drawing', SkelDrawing);
