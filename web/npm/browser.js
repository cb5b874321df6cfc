import createSkel from 'skel-core';
import { SkelError } from '../src/skel.js';
import { rigBy } from './rig.js';

async function load(file) {
  const url = new URL(file, import.meta.url);
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  return new Uint8Array(await answer.arrayBuffer());
}

export { SkelError };
export const rig = rigBy(createSkel, load);
