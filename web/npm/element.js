// <skel-drawing src="hero.png" clip="dance" plan="auto">: a drawing that moves. Turned by mouse, finger and arrow keys;
// says `rigged` (detail: the character) or `error` (detail: what is wrong). One worker does the work of all of them.
import { ModelStage } from '../src/stage3d.js';
import { startWorker } from './worker.js';

let worker;

export class SkelDrawing extends HTMLElement {
  static observedAttributes = ['src', 'clip', 'plan'];
  #stage;
  #made = 0;

  connectedCallback() {
    if (this.#stage) return;
    const root = this.attachShadow({ mode: 'open' });
    root.innerHTML = '<style>:host{display:inline-block;width:320px;height:320px}canvas{width:100%;height:100%;display:block}</style>' +
      '<canvas tabindex="0" role="img" part="canvas"></canvas>';
    const canvas = root.querySelector('canvas');
    canvas.ariaLabel = this.getAttribute('alt') ?? '';
    canvas.addEventListener('keydown', ({ key }) => {
      if (key === 'ArrowLeft' || key === 'ArrowRight') this.#stage.turn(key === 'ArrowLeft' ? -0.2 : 0.2);
    });
    try {
      this.#stage = new ModelStage(canvas);
    } catch (error) {
      this.#say(error);
      return;
    }
    this.#rig();
  }

  attributeChangedCallback(attribute) {
    if (!this.#stage) return;
    if (attribute === 'clip') this.#stage.play(this.clip);
    else this.#rig();
  }

  get clip() { return this.getAttribute('clip') ?? 'idle'; }
  set clip(name) { this.setAttribute('clip', name); }
  get clips() { return (this.#stage?.clips ?? []).map(({ name }) => name); }

  // A drawing given as bytes, Blob or File, as rig() takes it.
  async show(drawing, options = {}) {
    const mine = ++this.#made;
    try {
      worker ??= startWorker();
      const character = await worker.rig(drawing, { plan: this.getAttribute('plan') ?? 'auto', ...options });
      if (mine !== this.#made) return; // another drawing was asked for since
      this.#stage.clip = this.clip;
      await this.#stage.show(character.glb);
      this.dispatchEvent(new CustomEvent('rigged', { detail: character }));
    } catch (error) {
      this.#say(error);
    }
  }

  async #rig() {
    const src = this.getAttribute('src');
    if (!src) return;
    try {
      const answer = await fetch(src);
      if (!answer.ok) throw new Error(`${src}: ${answer.status} ${answer.statusText}`);
      await this.show(await answer.blob(), { name: src.split(/[?#]/)[0].split('/').pop() || 'drawing.png' });
    } catch (error) {
      this.#say(error);
    }
  }

  #say(error) { this.dispatchEvent(new CustomEvent('error', { detail: error })); }
}

customElements.define('skel-drawing', SkelDrawing);
