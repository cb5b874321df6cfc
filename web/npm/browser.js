import createSkel from 'skel-core';
import { SkelError } from '../src/skel.js';
import { rigBy } from './rig.js';

// Written out, for bundlers, which find the files by this and take them along.
const kFiles = {
  'skel.wasm': new URL('./skel.wasm', import.meta.url),
  'nets/page_net.bin': new URL('./nets/page_net.bin', import.meta.url),
  'nets/part_net.bin': new URL('./nets/part_net.bin', import.meta.url),
  'nets/joint_net.bin': new URL('./nets/joint_net.bin', import.meta.url),
  'nets/quadruped_joint_net.bin': new URL('./nets/quadruped_joint_net.bin', import.meta.url),
};

async function load(file) {
  const url = kFiles[file], answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  return new Uint8Array(await answer.arrayBuffer());
}

export { SkelError };
export const rig = rigBy(createSkel, load);
