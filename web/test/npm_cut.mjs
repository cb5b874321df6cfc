// A file of the package that is cut: an error that is none of what was given, nothing on stderr, and the next call starts
// anew. FILE and how the message begins are given; runs in a project that has the package and hero.png (npm.mjs).
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { rig, SkelError } from 'skel';

const [file, sentence] = process.argv.slice(2);
const path = `node_modules/skel/${file}`, bytes = await readFile(path), png = await readFile('hero.png');
await writeFile(path, bytes.subarray(0, 1000));
try {
  await assert.rejects(rig(png), (error) => !(error instanceof SkelError) && error.message.startsWith(sentence));
} finally {
  await writeFile(path, bytes);
}
assert.equal((await rig(png)).plan, 'biped');
