// Khronos' glTF validator and three.js' loader on each file given. See ../validate.
import { readFile } from 'node:fs/promises';
import validator from 'gltf-validator';

// What three.js expects of a browser.
globalThis.self = globalThis;
globalThis.ProgressEvent ??= class ProgressEvent {};
globalThis.createImageBitmap ??= async () => ({ width: 1, height: 1, close() {} });
const { GLTFLoader } = await import('three/examples/jsm/loaders/GLTFLoader.js');

const kBipedBones = 17;
const kMessages = 10;

const separator = process.argv.indexOf('--');
const words = process.argv.slice(2, separator < 0 ? undefined : separator);
const given = words[0] === '--bones' ? Number(words[1]) : null;
const files = given === null ? words : words.slice(2);
const clips = separator < 0 ? null : process.argv.slice(separator + 1).sort();

async function khronos(bytes) {
  const { issues } = await validator.validateBytes(bytes, { maxIssues: 1000 });
  const problems = issues.messages
    .filter((message) => message.severity < 2)
    .map((message) => `Khronos: ${message.code} at ${message.pointer}: ${message.message}`);
  const total = issues.numErrors + issues.numWarnings;
  if (total > kMessages) problems.splice(kMessages, Infinity, `Khronos: ${total} errors and warnings in all`);
  return problems;
}

async function expectedBones(file) {
  if (given !== null) return given;
  try {
    return JSON.parse(await readFile(file.replace(/\.glb$/, '.skeleton.json'))).joints.length;
  } catch (error) {
    if (error.code === 'ENOENT') return kBipedBones;
    throw error;
  }
}

async function three(bytes, expected) {
  const gltf = await new GLTFLoader().parseAsync(new Uint8Array(bytes).buffer, '');
  const problems = [];
  const skinned = [];
  gltf.scene.traverse((object) => object.isSkinnedMesh && !object.material.userData.ink_hull && skinned.push(object));
  if (skinned.length !== 1) return [`three.js: ${skinned.length} skinned meshes, 1 expected`];
  const bones = skinned[0].skeleton.bones.filter((bone) => !bone.name.startsWith('hanging_'));
  if (bones.length !== expected) problems.push(`three.js: ${bones.length} bones, ${expected} expected`);
  const found = gltf.animations.map((animation) => animation.name).sort();
  if (clips ? found.join() !== clips.join() : found.length === 0)
    problems.push(`three.js: clips [${found.join(', ')}], ${clips ? `[${clips.join(', ')}]` : 'at least one'} expected`);
  // In the rest pose the skin must leave every vertex where it is.
  gltf.scene.updateMatrixWorld(true);
  const position = skinned[0].geometry.attributes.position;
  let moved = 0;
  for (let i = 0; i < position.count; ++i) {
    const rest = skinned[0].position.clone().fromBufferAttribute(position, i);
    moved = Math.max(moved, skinned[0].applyBoneTransform(i, rest.clone()).distanceTo(rest));
  }
  if (!(moved < 1e-4)) problems.push(`three.js: the rest pose moves vertices by up to ${moved} m`);
  return problems;
}

let failed = 0;
for (const file of files) {
  let problems;
  try {
    const bytes = await readFile(file);
    problems = await khronos(bytes);
    if (problems.length === 0) problems = await three(bytes, await expectedBones(file));
  } catch (error) {
    problems = [error.message];
  }
  if (problems.length > 0) ++failed;
  for (const problem of problems) console.error(`${file}: ${problem}`);
}
console.log(`validate: ${files.length - failed} of ${files.length} files passed`);
process.exit(failed > 0 ? 1 : 0);
