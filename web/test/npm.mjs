// The npm package as its users have it: node npm.mjs OUT SKEL_INFER. Packs OUT/npm, installs it into an empty project and
// runs examples/javascript there, in node and in headless Chromium. Pictures go to OUT/shots.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { cp, mkdir, mkdtemp, readFile, stat, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { promisify } from 'node:util';
import { chromium } from 'playwright-core';

const [out, infer] = process.argv.slice(2);
const root = new URL('../..', import.meta.url).pathname, modules = `${root}/web/node_modules`;
const kMostBytes = 6e6;
const kDrawing = `${root}/datasets/characters/gingerbread.png`;
const kPatience_ms = 120_000;
const run = promisify(execFile);

const project = await mkdtemp(join(tmpdir(), 'skel-npm-'));
const inProject = (program, ...values) => run(program, values, { cwd: project });
const { stdout } = await inProject('npm', 'pack', `${out}/npm`, '--silent');
const packed = join(project, stdout.trim());
const { size } = await stat(packed);
assert.ok(size <= kMostBytes, `${size} bytes`);
await writeFile(join(project, 'package.json'), JSON.stringify({ name: 'empty', private: true, type: 'module' }));
await inProject('npm', 'install', packed, `${modules}/three`, '--offline', '--no-audit', '--no-fund', '--silent');
await cp(`${root}/examples/javascript`, project, { recursive: true });
await cp(kDrawing, join(project, 'hero.png'));

// In node.
const { stdout: said } = await inProject('node', 'rig.mjs', 'hero.png', 'hero.glb');
assert.match(said, /^hero\.png: biped, confidence 0\.\d\d/);
assert.equal((await readFile(join(project, 'hero.glb'))).toString('latin1', 0, 4), 'glTF');
await writeFile(join(project, 'empty.png'), '');
await assert.rejects(inProject('node', 'rig.mjs', 'empty.png', 'x.glb'), ({ code, stderr }) => code === 2 && stderr === 'empty.png: is empty\n');

await run(infer, [join(project, 'hero.png'), '-o', project, '--formats', 'json', '--clips', 'none', '--quiet']);
await writeFile(join(project, 'same.mjs'), `
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { rig, SkelError } from 'skel';
const drawing = await readFile('hero.png'), name = 'hero.png';
const character = await rig(drawing, { name });
const theirs = JSON.parse(await readFile('hero.skeleton.json', 'utf8'));
for (const [i, { image }] of character.skeleton.joints.entries())
  assert.ok(Math.hypot(image[0] - theirs.joints[i].image[0], image[1] - theirs.joints[i].image[1]) <= 0.1);
assert.equal(character.mask.length, character.width * character.height);

const hand = character.skeleton.joints.find((joint) => joint.name === 'left_hand');
hand.image[1] -= 20;
hand.origin = 'edited';
const [mended, again] = await Promise.all([rig(drawing, { name, skeleton: character.skeleton }), rig(drawing, { name })]);
assert.equal(mended.skeleton.joints.find((joint) => joint.name === 'left_hand').image[1], hand.image[1]);
assert.deepEqual(again.glb, character.glb);
assert.notDeepEqual(mended.glb, character.glb);

const rgba = new Uint8Array(4 * 100 * 100).fill(255);
await assert.rejects(rig({ width: 100, height: 100, rgba }, { name: 'white' }), (error) => error instanceof SkelError && error.message.startsWith('white: '));
await assert.rejects(rig(drawing, { name, mask: drawing.subarray(0, 100) }), /^SkelError: the mask: /);
await assert.rejects(rig(drawing, { name, plan: 'snake' }), SkelError);
await assert.rejects(rig(drawing, { name, skeleton: '{' }), /^SkelError: the skeleton: /);
assert.deepEqual((await rig(drawing, { name })).glb, character.glb);
`);
await inProject('node', 'same.mjs');

// In TypeScript.
await inProject('node', `${modules}/typescript/bin/tsc`, '--noEmit', '--strict', '--module', 'nodenext', '--target', 'es2022', '--lib', 'es2022,dom', 'typed.ts');

// In a browser.
const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm', '.png': 'image/png' };
const server = createServer(async ({ url }, answer) => {
  try {
    const bytes = await readFile(join(project, new URL(url, 'http://x').pathname));
    answer.writeHead(200, { 'Content-Type': kTypes[extname(url)] ?? 'application/octet-stream' }).end(bytes);
  } catch {
    answer.writeHead(404).end();
  }
}).listen(0, '127.0.0.1');
await new Promise((resolve) => server.once('listening', resolve));
const site = `http://127.0.0.1:${server.address().port}`;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
await mkdir(`${out}/shots`, { recursive: true });
try {
  const open = async (file) => {
    const page = await browser.newPage({ viewport: { width: 500, height: 500 } });
    page.setDefaultTimeout(kPatience_ms);
    page.problems = [];
    page.on('pageerror', (error) => page.problems.push(error.message));
    await page.goto(`${site}/${file}`);
    return page;
  };
  const moves = async (page) => {
    const before = await page.screenshot();
    await page.waitForTimeout(700);
    return !before.equals(await page.screenshot());
  };

  const scene = await open('scene.html');
  await scene.waitForSelector('body[data-ready]');
  assert.ok(await moves(scene));
  await scene.screenshot({ path: `${out}/shots/npm-scene.png` });
  assert.deepEqual(scene.problems, []);
  await scene.close();

  const page = await open('element.html');
  await page.waitForFunction(() => document.querySelector('skel-drawing').clips?.includes('dance'));
  assert.ok(await moves(page));
  await page.screenshot({ path: `${out}/shots/npm-element.png` });
  // A JPEG, which the browser reads; what is no picture; a file that is not there.
  const plan = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(1, 1), picture = await createImageBitmap(await (await fetch('hero.png')).blob());
    [canvas.width, canvas.height] = [picture.width, picture.height];
    const context = canvas.getContext('2d');
    context.fillStyle = 'white';
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(picture, 0, 0);
    const element = document.querySelector('skel-drawing');
    const rigged = new Promise((resolve) => element.addEventListener('rigged', ({ detail }) => resolve(detail.plan), { once: true }));
    element.show(await canvas.convertToBlob({ type: 'image/jpeg' }), { name: 'hero.jpg' });
    return rigged;
  });
  assert.equal(plan, 'biped');
  const complaint = (work) => page.evaluate(`new Promise((resolve) => {
    const element = document.querySelector('skel-drawing');
    element.addEventListener('error', ({ detail }) => resolve(detail.name + ': ' + detail.message), { once: true });
    ${work}
  })`);
  assert.match(await complaint("element.show(new Blob(['x']), { name: 'x.png' });"), /^SkelError: x\.png: /);
  assert.match(await complaint("element.src = 0; element.setAttribute('src', 'none.png');"), /none\.png: 404/);
  await page.evaluate(() => { document.querySelector('skel-drawing').clip = ''; });
  await page.waitForTimeout(300);
  assert.ok(!await moves(page));
  assert.deepEqual(page.problems, []);
} finally {
  await browser.close();
  server.close();
}
console.log(`npm: ${Math.round(size / 1e4) / 100} MB packed; node, TypeScript, a three.js scene and the element work`);
