/** Something is wrong with what was given; the message is one sentence for whoever gave it. */
export class SkelError extends Error {
  name: 'SkelError';
}

/** Bytes in memory of their own: `Uint8Array<ArrayBuffer>` from TypeScript 5.7 on, `Uint8Array` before. */
export type Bytes = ReturnType<Uint8Array['slice']>;

/** A picture that is decoded already: width × height pixels, row by row from the top, 4 bytes each (not premultiplied); of other lengths it is refused. */
export interface Pixels {
  width: number;
  height: number;
  rgba: Uint8Array | Uint8ClampedArray;
}

/** A picture's file: PNG in node; whatever the browser shows in a browser. */
export type Drawing = Uint8Array | ArrayBuffer | Blob | Response | Pixels;

export type Plan = 'biped' | 'quadruped';

export interface RigOptions {
  /** The drawing's file name, for messages and for the names in the GLB. */
  name?: string;
  /** `auto`: the body plan that the figure fits. Not another one than that of `skeleton`. */
  plan?: Plan | 'auto';
  /** Which figure of the drawing, 1 is the largest (the default). */
  figure?: number;
  /** Whether the figure is not turned: no other orientation is tried. */
  upright?: boolean;
  /** A PNG file of the drawing's size (or of that of the character, where it was `scaled`), the figure white, instead of looking for it. */
  mask?: Uint8Array | ArrayBuffer | Blob | null;
  /** A skeleton file, as it was returned and then mended: rigs with these joints. */
  skeleton?: SkeletonFile | string | null;
}

export interface Joint {
  name: string;
  parent: string | null;
  /** Pixels of the drawing, from the centre of its top left pixel. */
  image: [number, number];
  /** Metres: x to the right, y up from the ground, z to the viewer. */
  position: [number, number, number];
  /** 0 … 1 */
  confidence: number;
  origin: string;
  /** Where the program itself put it; it counts as placed by a person where `image` is something else. */
  found?: [number, number];
  [more: string]: unknown;
}

/** What skel-infer writes as .skeleton.json (docs/formats.md). */
export interface SkeletonFile {
  format: 'skel-skeleton';
  version: number;
  template: string;
  joints: Joint[];
  [more: string]: unknown;
}

export interface Character {
  name: string;
  /** Of the picture that was rigged, px. */
  width: number;
  height: number;
  /** Whether the picture was made smaller (more than 6 million px, in a browser). */
  scaled: boolean;
  plan: Plan;
  /** 0 … 1 */
  confidence: number;
  warnings: string[];
  /** How many figures the drawing shows. */
  figures: number;
  skeleton: SkeletonFile;
  /** width × height bytes, 255 on the figure. */
  mask: Bytes;
  /** Of each stage. */
  times_ms: Record<string, number>;
  /** glTF 2.0, binary: mesh, skin, texture, all clips. */
  glb: Bytes;
  /** A PNG file. */
  texture: Bytes;
}

/**
 * Rigs a drawing. The core and its nets (8 MB) are loaded by the first call. What is given is copied at once: it may be
 * changed while the promise is waited for. Rejects with a SkelError where what was given is wrong.
 */
export function rig(drawing: Drawing, options?: RigOptions): Promise<Character>;
