// rig() in a thread of its own, so that the page never freezes: one drawing at a time, in the order of the calls.
import { SkelError } from '../src/skel.js';

export { SkelError };

export function startWorker() {
  const waiting = new Map();
  let last = 0;
  const worker = new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  const stop = (reason) => {
    worker.terminate();
    for (const { reject } of waiting.values()) reject(new Error(reason));
    waiting.clear();
  };
  worker.onmessage = ({ data: { id, character, error, name } }) => {
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (character) resolve(character);
    else reject(name === 'SkelError' ? new SkelError(error) : new Error(error));
  };
  worker.onerror = (event) => stop(event.message ?? 'the worker has ended');
  return {
    rig: (drawing, options) => new Promise((resolve, reject) => {
      waiting.set(++last, { resolve, reject });
      worker.postMessage({ id: last, drawing, options });
    }),
    stop: () => stop('stopped'),
  };
}
