// The core in node against skel-infer: node core.mjs WASM_DIR NATIVE PLAN PNG... NATIVE holds what skel-infer wrote of
// the pictures (json, glb). Joints within 0.1 px, and GLB files byte for byte unless --glb-may-differ says otherwise.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { basename } from 'node:path';

const [wasmDir, native, plan, ...files] = process.argv.slice(2);
const kTolerance_px = 0.1;

globalThis.fetch = undefined; // node's is not for files
const createSkel = createRequire(import.meta.url)(`${wasmDir}/skel.js`);
const core = await createSkel({ wasmBinary: await readFile(`${wasmDir}/skel.wasm`) });

let worst = 0, sameGlb = 0, failed = 0;
const times = { web: [], native: [] };
const fail = (name, problem) => {
  console.error(`${name}: ${problem}`);
  ++failed;
};
for (const file of files) {
  const name = basename(file), stem = name.replace(/\.png$/, '');
  const picture = core.decode(await readFile(file), name);
  if (picture.error) {
    fail(name, picture.error);
    continue;
  }
  const start = performance.now();
  const found = core.rig({ ...picture, file: name, mask: null, skeleton: null, skeletonFile: '', plan, figure: 1 });
  times.web.push(performance.now() - start);
  if (found.error) {
    fail(name, found.error);
    continue;
  }
  const mine = JSON.parse(found.skeleton), theirs = JSON.parse(await readFile(`${native}/${stem}.skeleton.json`, 'utf8'));
  const off = Math.max(...mine.joints.map((joint, i) =>
    Math.hypot(joint.image[0] - theirs.joints[i].image[0], joint.image[1] - theirs.joints[i].image[1])));
  worst = Math.max(worst, off);
  if (off > kTolerance_px) fail(name, `a joint lies ${off.toFixed(2)} px from the native one`);
  if (mine.figure.sha256 !== theirs.figure.sha256) fail(name, 'the figure is outlined otherwise');
  if (JSON.stringify(mine.warnings) !== JSON.stringify(theirs.warnings)) fail(name, `says ${mine.warnings}, not ${theirs.warnings}`);
  if (Buffer.compare(core.glb(), await readFile(`${native}/${stem}.glb`)) === 0) ++sameGlb;
}
times.web.sort((a, b) => a - b);
console.log(`${plan}: ${files.length} drawings, joints at most ${worst.toFixed(3)} px apart, ${sameGlb} GLB files the same byte for byte, ` +
  `median ${times.web[times.web.length >> 1]?.toFixed(0)} ms`);
process.exit(failed ? 1 : 0);
