// node thread.mjs DRAWING.png OUT.glb: rigs in a thread, while this one goes on.
import { readFile, writeFile } from 'node:fs/promises';
import { isMainThread, parentPort, Worker } from 'node:worker_threads';
import { rig } from 'skel';

if (isMainThread) {
  const [file, out] = process.argv.slice(2), thread = new Worker(new URL(import.meta.url));
  thread.once('message', async ({ glb, error }) => {
    if (error) console.error(error);
    else await writeFile(out, glb);
    process.exitCode = error ? 2 : 0;
    await thread.terminate();
  });
  thread.postMessage({ drawing: await readFile(file), options: { name: file } });
} else {
  parentPort.on('message', async ({ drawing, options }) => {
    parentPort.postMessage(await rig(drawing, options).catch(({ message }) => ({ error: message })));
  });
}
