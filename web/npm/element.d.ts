import type { Character, Drawing, Plan, RigOptions } from './index.js';

export interface SkelDrawingEventMap extends Omit<HTMLElementEventMap, 'error' | 'rigged'> {
  rigged: CustomEvent<Character>;
  /**
   * Of a drawing that cannot be shown, a clip that it does not have, or a WebGL context that the browser took away and has
   * not given back (then it stands still until it is given back, or another drawing is shown). A SkelError where what
   * was given is wrong.
   */
  error: CustomEvent<Error>;
}

/** `<skel-drawing src="hero.png" clip="dance" plan="auto">`. Needs three.js. In node it can be imported, and nothing else. What is wrong is shown in it, too: `::part(error)`. */
export class SkelDrawing extends HTMLElement {
  /** As the attribute; '' is none, and takes away the one that is shown. */
  src: string;
  plan: Plan | 'auto';
  /** The clip that plays; '' is the rest pose. */
  clip: string;
  /** Names of the clips there are. */
  readonly clips: string[];
  /**
   * Rigs and shows a drawing, in an element that is in the page. Resolves to the character, or to undefined where another
   * drawing was asked for since; rejects with what the event `error` says.
   */
  show(drawing: Exclude<Drawing, Response>, options?: RigOptions): Promise<Character | undefined>;

  addEventListener<K extends keyof SkelDrawingEventMap>(
    type: K, listener: (this: SkelDrawing, event: SkelDrawingEventMap[K]) => unknown, options?: boolean | AddEventListenerOptions): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<K extends keyof SkelDrawingEventMap>(
    type: K, listener: (this: SkelDrawing, event: SkelDrawingEventMap[K]) => unknown, options?: boolean | EventListenerOptions): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}

declare global {
  interface HTMLElementTagNameMap {
    'skel-drawing': SkelDrawing;
  }
  interface HTMLElementEventMap {
    rigged: CustomEvent<Character>;
  }
}
