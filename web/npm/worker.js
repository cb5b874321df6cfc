// rig() in a thread of its own, so that the page never freezes: one drawing at a time, in the order of the calls.
import { SkelError } from '../src/skel.js';
import { checkedGiven } from './given.js';

export { SkelError };

export function startWorker() {
  if (!globalThis.Worker) throw new SkelError('startWorker() is for browsers; in node call rig() in a thread of node:worker_threads');
  const waiting = new Map();
  let last = 0, ended = ''; // why
  const worker = new Worker(new URL('./worker-thread.js', import.meta.url), { type: 'module' });
  const stop = (reason) => {
    ended ||= reason;
    worker.terminate();
    for (const { reject } of waiting.values()) reject(new Error(ended));
    waiting.clear();
  };
  worker.onmessage = ({ data: { id, character, error, name } }) => {
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (character) resolve(character);
    else reject(name === 'SkelError' ? new SkelError(error) : new Error(error));
  };
  worker.onerror = (event) => stop(event.message ?? 'the worker has ended: can worker-thread.js be loaded?');
  return {
    async rig(drawing, options) {
      const request = { id: ++last, ...checkedGiven(drawing, options) };
      if (ended) throw new Error(ended);
      try {
        worker.postMessage(request);
      } catch (error) {
        throw new SkelError(`what was given cannot be sent to a worker (${error.message}); of a Response give its blob()`);
      }
      return new Promise((resolve, reject) => waiting.set(request.id, { resolve, reject }));
    },
    stop: () => stop('stopped'),
  };
}
