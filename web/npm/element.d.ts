import type { Character, Drawing, RigOptions } from './index.js';

/** `<skel-drawing src="hero.png" clip="dance" plan="auto">`. Needs three.js. Events: `rigged` (detail: Character), `error` (detail: Error). */
export class SkelDrawing extends HTMLElement {
  /** The clip that plays; '' is the rest pose. */
  clip: string;
  /** Names of the clips there are. */
  readonly clips: string[];
  show(drawing: Exclude<Drawing, Response>, options?: RigOptions): Promise<void>;
}

declare global {
  interface HTMLElementTagNameMap {
    'skel-drawing': SkelDrawing;
  }
  interface HTMLElementEventMap {
    rigged: CustomEvent<Character>;
  }
}
