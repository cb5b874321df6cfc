// The npm package as its users have it: node npm.mjs OUT SKEL_INFER. Packs OUT/npm, installs it into an empty project and
// runs examples/javascript there, in node, through a new and an old TypeScript and in headless Chromium, as it is and in a
// bundle of esbuild; the examples of the documentation, too. Pictures go to OUT/shots.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { cp, mkdir, mkdtemp, readdir, readFile, stat, symlink, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { promisify } from 'node:util';
import { build } from 'esbuild';
import { chromium } from 'playwright-core';
import { testElements, testLargeMasks } from './npm_elements.mjs';

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

await inProject('node', 'thread.mjs', 'hero.png', 'thread.glb');
assert.equal((await readFile(join(project, 'thread.glb'))).toString('latin1', 0, 4), 'glTF');
await assert.rejects(inProject('node', 'thread.mjs', 'empty.png', 'x.glb'), ({ code, stderr }) => code === 2 && stderr === 'empty.png: is empty\n');

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
assert.deepEqual((await rig(drawing, { name })).glb, character.glb);
`);
await inProject('node', 'same.mjs');
await cp(`${root}/web/test/npm_given.mjs`, join(project, 'given.mjs'));
await inProject('node', 'given.mjs');
await cp(`${root}/web/test/npm_cut.mjs`, join(project, 'cut.mjs'));
for (const [file, sentence] of [['nets/joint_net.bin', 'joint net of the biped: '], ['nets/page_net.bin', 'page net: '], ['skel.wasm', '']])
  assert.equal((await inProject('node', 'cut.mjs', file, sentence)).stderr, '', file);
// A server imports the element with the pages that it writes.
await inProject('node', '--input-type=module', '-e', "import { SkelDrawing } from 'skel/element'; if (typeof SkelDrawing !== 'function') process.exit(1);");

// In TypeScript: the example, those of the documentation, and what must not compile.
await symlink(`${modules}/@types`, join(project, 'node_modules/@types'));
await writeFile(join(project, 'around.d.ts'), `
import type { PerspectiveCamera, Scene, WebGLRenderer } from 'three';
declare global { const renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, drawing: Uint8Array; }
`);
const typed = ['around.d.ts', 'typed.ts', 'wrong.ts'];
await writeFile(join(project, 'wrong.ts'), `
import { rig } from 'skel';
// @ts-expect-error
rig('hero.png');
// @ts-expect-error
rig(new Uint8Array(), { plan: 'spider' });
// @ts-expect-error
rig(new Uint8Array(), { figur: 1 });
`);
for (const file of ['web/npm/README.md', 'docs/javascript.md'])
  for (const [, example] of (await readFile(join(root, file), 'utf8')).matchAll(/^```js\n(.*?)^```$/gms)) {
    typed.push(`example${typed.length}.ts`);
    await writeFile(join(project, typed.at(-1)), `${example}\nexport {};\n`);
  }
assert.ok(typed.length >= 6);
for (const compiler of ['typescript', 'typescript-5.6'])
  await inProject('node', `${modules}/${compiler}/bin/tsc`, '--noEmit', '--strict', '--skipLibCheck', '--module', 'nodenext', '--target', 'es2022', '--lib', 'es2022,dom', ...typed)
    .catch(({ stdout: complaints }) => assert.fail(`${compiler}: ${complaints}`));

// Bundled, as docs/javascript.md says: what the bundle loads lies beside it.
const bundled = join(project, 'bundled');
await writeFile(join(project, 'app.mjs'), "import { rig } from 'skel';\nimport 'skel/element';\nglobalThis.rig = rig;\ntry { globalThis.evaluates = Boolean(Function('return 1')()); } catch { globalThis.evaluates = false; }\n");
await build({ entryPoints: [join(project, 'app.mjs')], bundle: true, format: 'esm', outfile: join(bundled, 'app.js') });
for (const file of await readdir(join(project, 'node_modules/skel')))
  if (/^(nets|skel\.wasm|worker-thread\.js|chunk-.*\.js)$/.test(file)) await cp(join(project, 'node_modules/skel', file), join(bundled, file), { recursive: true });
await writeFile(join(bundled, 'index.html'), '<!DOCTYPE html><script type="module" src="app.js"></script><skel-drawing src="../hero.png" clip="dance"></skel-drawing>');

// By the import map of the README.
const [map] = (await readFile(`${root}/web/npm/README.md`, 'utf8')).match(/<script type="importmap">.*?<\/script>/s);
await writeFile(join(project, 'mapped.html'), `<!DOCTYPE html>${map}<script type="module">
import { SkelError } from 'skel';
import { SkelError as theirs, startWorker } from 'skel/worker';
import 'skel/element';
if (SkelError === theirs && startWorker && customElements.get('skel-drawing')) document.body.dataset.ready = '';
</script>`);

// In a browser.
const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm', '.png': 'image/png' };
const kPolicy = "script-src 'self' 'wasm-unsafe-eval'"; // of the bundle's page: no more is needed
const server = createServer(async ({ url }, answer) => {
  try {
    const path = new URL(url, 'http://x').pathname, bytes = await readFile(join(project, path));
    const type = { 'Content-Type': kTypes[extname(path)] ?? 'application/octet-stream' };
    answer.writeHead(200, path.startsWith('/bundled/') ? { ...type, 'Content-Security-Policy': kPolicy } : type).end(bytes);
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

  const mapped = await open('mapped.html');
  await mapped.waitForSelector('body[data-ready]', { state: 'attached' });
  await mapped.close();

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
  const shown = () => page.evaluate(() => document.querySelector('skel-drawing').shadowRoot.querySelector('[part=error]').textContent);
  assert.match(await complaint("element.show(new Blob(['x']), { name: 'x.png' }).catch(() => {});"), /^SkelError: x\.png: is not a picture/);
  assert.match(await shown(), /^x\.png: is not a picture/);
  assert.match(await page.evaluate(() => document.querySelector('skel-drawing').show('x').catch(String)), /^SkelError: the drawing: is the text "x"/);
  assert.match(await page.evaluate(() => document.createElement('skel-drawing').show(new Blob(['x'])).catch(String)), /^SkelError: <skel-drawing>: has not been in a page/);
  assert.match(await complaint("element.src = 'none.png';"), /^SkelError: none\.png: 404/);
  assert.match(await complaint("element.clip = 'fly';"), /^SkelError: clip: there is no "fly"; there are .*dance/);
  assert.match(await shown(), /"fly"/);
  await page.evaluate(() => { document.querySelector('skel-drawing').clip = 'dance'; });
  assert.equal(await shown(), '');
  // The last of two drawings counts.
  assert.deepEqual(await page.evaluate(async () => {
    const element = document.querySelector('skel-drawing'), hero = await (await fetch('hero.png')).blob();
    const both = await Promise.all([element.show(new Blob(['x'])), element.show(hero, { name: 'second.png' })]);
    return both.map((character) => character?.name);
  }), [undefined, 'second.png']);
  // Of a worker that has been stopped nothing is waited for; what cannot be sent to one is said.
  assert.deepEqual(await page.evaluate(async () => {
    const { startWorker } = await import('./node_modules/skel/worker.js');
    const hero = await (await fetch('hero.png')).blob(), worker = startWorker();
    const said = [await worker.rig(await fetch('hero.png')).catch(({ name }) => name), await worker.rig(hero, { figure: 0 }).catch(({ name }) => name)];
    const asked = worker.rig(hero).catch(String);
    worker.stop();
    return [...said, await asked, await worker.rig(hero).catch(String)];
  }), ['SkelError', 'SkelError', 'Error: stopped', 'Error: stopped']);
  await page.evaluate(() => { document.querySelector('skel-drawing').clip = ''; });
  await page.waitForTimeout(300);
  assert.ok(!await moves(page));
  await testLargeMasks(page);
  await testElements(page, `${out}/shots`);
  assert.deepEqual(page.problems, []);
  await page.close();

  const bundle = await open('bundled/index.html');
  await bundle.evaluate(async () => {
    while (!document.querySelector('skel-drawing').clips?.includes('dance')) await new Promise((resolve) => setTimeout(resolve, 50));
  });
  assert.equal(await bundle.evaluate(() => globalThis.evaluates), false);
  assert.equal(await bundle.evaluate(async () => (await globalThis.rig(await (await fetch('../hero.png')).blob())).plan), 'biped');
  assert.deepEqual(bundle.problems, []);
} finally {
  await browser.close();
  server.close();
}
console.log(`npm: ${Math.round(size / 1e4) / 100} MB packed; node, TypeScript, a three.js scene, the element and a bundle work`);
