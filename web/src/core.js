// The worker's calls, as promises. A worker that has crashed is started anew.
let worker, asked, next = 0;
let waiting = new Map();

// In the single file, worker and core stand in the page; else they lie beside it.
const inlined = (id) => document.getElementById(id)?.textContent;

async function asset(file) {
  return inlined(file) ?? new Uint8Array(await (await fetch(file)).arrayBuffer());
}

function ask(call, values) {
  return new Promise((resolve, reject) => {
    waiting.set(++next, { resolve, reject });
    worker.postMessage({ id: next, call, values });
  });
}

export function start() {
  worker?.terminate();
  for (const { reject } of waiting.values()) reject(new Error('stopped'));
  waiting = new Map();
  const source = inlined('skel-worker');
  worker = new Worker(source ? URL.createObjectURL(new Blob([source], { type: 'text/javascript' })) : 'worker.js');
  worker.onerror = (event) => {
    for (const { reject } of waiting.values()) reject(new Error(event.message ?? 'worker'));
    waiting.clear();
  };
  worker.onmessage = ({ data: { id, result, error, fatal } }) => {
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (error === undefined) resolve(result);
    else reject(Object.assign(new Error(error), { fatal }));
  };
  asked = Promise.all(['skel.wasm', 'nets.zip'].map(asset)).then((assets) => ask('start', assets));
  return asked;
}

async function call(name, ...values) {
  await asked;
  return ask(name, values);
}

export const core = Object.fromEntries(
  ['open', 'readMask', 'rig', 'glb', 'flat', 'flatClip', 'texture', 'drawing', 'mask'].map((name) => [name, (...values) => call(name, ...values)]));
