import type { Character, Drawing, RigOptions } from './index.js';
export { SkelError } from './index.js';

export interface RigWorker {
  /** rig() in the worker: one drawing at a time, in the order of the calls. Not a Response, which cannot be sent there. */
  rig(drawing: Exclude<Drawing, Response>, options?: RigOptions): Promise<Character>;
  stop(): void;
}

/** In browsers: a module worker beside this file. */
export function startWorker(): RigWorker;
