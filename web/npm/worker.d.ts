import type { Character, Drawing, RigOptions } from './index.js';
export { SkelError } from './index.js';

export interface RigWorker {
  /** rig() in the worker: one drawing at a time, in the order of the calls. Not a Response, which cannot be sent there. */
  rig(drawing: Exclude<Drawing, Response>, options?: RigOptions): Promise<Character>;
  /** Ends the thread: what is still asked for, and whatever will be, rejects ("stopped"). */
  stop(): void;
}

/** In browsers: a module worker beside this file. In node a SkelError: there rig() is called in a thread of node:worker_threads. */
export function startWorker(): RigWorker;
