import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { SkelError } from '../src/skel.js';
import { rigBy } from './rig.js';

export { SkelError };
export const rig = rigBy(createRequire(import.meta.url)('./skel-core.cjs'), (file) => readFile(new URL(file, import.meta.url)));
