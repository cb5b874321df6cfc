// Drives the page from file:// in a headless browser, chromium or firefox: node page.mjs OUT SKEL_INFER BROWSER.
// Pictures go to OUT/shots. Debian's Firefox is driven by WebDriver BiDi; later versions of playwright-core ask it for
// what it lacks.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { mkdir, mkdtemp, readFile, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { promisify } from 'node:util';
import { unzipSync } from 'fflate';
import { chromium, firefox } from 'playwright-core';

const [out, infer, browserName] = process.argv.slice(2);
const root = new URL('../..', import.meta.url).pathname;
const shots = join(out, browserName === 'chromium' ? 'shots' : `shots-${browserName}`), scratch = await mkdtemp(join(tmpdir(), 'skel-web-'));
await mkdir(shots, { recursive: true });

const kSoftwareGl = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
const launchers = {
  chromium: ({ webgl = true, simd = true } = {}) => chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', ...(webgl ? kSoftwareGl : ['--disable-gpu', '--disable-3d-apis']), ...(simd ? [] : ['--js-flags=--no-enable-sse4-1'])],
  }),
  firefox: ({ webgl = true } = {}) => firefox.launch({
    channel: 'moz-firefox', executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr',
    firefoxUserPrefs: { 'webgl.disabled': !webgl, 'webgl.force-enabled': webgl },
  }),
};
const launch = launchers[browserName];
const kPatience_ms = 120_000;

async function openPage(browser, { width = 1280, height = 900, url = `file://${out}/skel.html`, runs = true, ...more } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, locale: 'en-GB', acceptDownloads: true, ...more });
  context.setDefaultTimeout(kPatience_ms);
  const page = await context.newPage();
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  page.on('console', (message) => message.type() === 'error' && page.problems.push(message.text()));
  await page.goto(url);
  if (runs) await page.waitForSelector('body[data-ready]');
  return page;
}
const idle = (page) => page.waitForSelector('#status:not(.busy)', { state: 'attached' });

// As a user drops them.
async function drop(page, ...files) {
  const data = await Promise.all(files.map(async ([name, source]) =>
    [name, (Buffer.isBuffer(source) ? source : await readFile(source)).toString('base64')]));
  await page.evaluate((dropped) => {
    const transfer = new DataTransfer();
    for (const [name, text] of dropped) transfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
    dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }, data);
  await page.waitForTimeout(50);
  await idle(page);
}
// Firefox reports no downloads here: what the page hands to it is read instead.
async function taken(page, button) {
  const [name, text] = await page.evaluate((id) => new Promise((resolve) => {
    const click = HTMLAnchorElement.prototype.click;
    HTMLAnchorElement.prototype.click = async function () {
      HTMLAnchorElement.prototype.click = click;
      const bytes = new Uint8Array(await (await fetch(this.href)).arrayBuffer());
      resolve([this.download, btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''))]);
    };
    document.getElementById(id).click();
  }), button);
  await writeFile(join(scratch, name), Buffer.from(text, 'base64'));
  await idle(page);
  return join(scratch, name);
}
async function save(page, button) {
  if (browserName === 'firefox') return taken(page, button);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click(`#${button}`)]);
  const path = join(scratch, download.suggestedFilename());
  await download.saveAs(path);
  await idle(page);
  return path;
}
const jointPlace = (page, name) => page.evaluate((joint) => {
  const box = document.querySelector(`[data-joint="${joint}"] .dot`).getBoundingClientRect();
  return [box.x + box.width / 2, box.y + box.height / 2];
}, name);
const jsonOf = async (path) => JSON.parse(await readFile(path, 'utf8'));
const jointOf = (skeleton, name) => skeleton.joints.find((joint) => joint.name === name);
const shot = (page, name) => page.screenshot({ path: join(shots, name), fullPage: true });

const drawing = (name, set = 'characters') => [`${name}.png`, join(root, 'datasets', set, `${name}.png`)];
const steps = [];
const step = (name, run) => steps.push([name, run]);

const browser = await launch();
const page = await openPage(browser);
console.log(`ready after ${await page.evaluate(() => document.body.dataset.ready)} ms`);
await shot(page, 'start.png');

step('a dropped drawing is rigged', async () => {
  await drop(page, drawing('gingerbread'));
  assert.equal(await page.locator('#error').isHidden(), true);
  assert.equal(await page.locator('.joint').count(), 17);
  assert.ok(await page.evaluate(() => document.getElementById('confidence').value) > 0.5);
  await page.waitForTimeout(1000);
  await shot(page, 'wide.png');
});

let before;
step('its skeleton and model are those of skel-infer', async () => {
  before = await jsonOf(await save(page, 'saveSkeleton'));
  const glb = await readFile(await save(page, 'saveGlb'));
  await promisify(execFile)(infer, [drawing('gingerbread')[1], '-o', scratch + '/native', '--formats', 'json,glb']);
  const native = await jsonOf(scratch + '/native/gingerbread.skeleton.json');
  for (const joint of native.joints)
    assert.ok(Math.hypot(...joint.image.map((x, k) => x - jointOf(before, joint.name).image[k])) <= 0.1, joint.name);
  assert.equal(glb.subarray(0, 4).toString(), 'glTF');
});

step('a joint is dragged, and undone', async () => {
  const [x, y] = await jointPlace(page, 'left_hand');
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 10, y + 20, { steps: 5 });
  await page.mouse.move(x - 15, y + 30, { steps: 5 });
  await page.mouse.up();
  await page.waitForSelector('#undo:enabled');
  await idle(page);
  const after = await jsonOf(await save(page, 'saveSkeleton'));
  assert.equal(jointOf(after, 'left_hand').origin, 'edited');
  const scale = await page.evaluate(() => document.querySelector('canvas.drawing').width / document.getElementById('stage').clientWidth);
  const moved = jointOf(after, 'left_hand').image.map((value, k) => value - jointOf(before, 'left_hand').image[k]);
  assert.ok(Math.hypot(moved[0] + 15 * scale, moved[1] - 30 * scale) < 2, `moved by ${moved}`);
  await page.click('#undo');
  await page.waitForSelector('#undo:disabled');
  assert.deepEqual((await jsonOf(await save(page, 'saveSkeleton'))).joints, before.joints);
});

step('a joint moves by arrow keys', async () => {
  await page.locator('[data-joint="right_hand"]').focus();
  await page.keyboard.press('ArrowUp');
  await page.waitForSelector('#undo:enabled');
  await idle(page);
  const after = await jsonOf(await save(page, 'saveSkeleton'));
  assert.ok(jointOf(after, 'right_hand').image[1] < jointOf(before, 'right_hand').image[1]);
});

step('the saved skeleton comes back, here and in skel-infer', async () => {
  const path = await save(page, 'saveSkeleton');
  const mended = await jsonOf(path);
  await drop(page, drawing('gingerbread'), ['gingerbread.skeleton.json', path]);
  assert.equal(await page.locator('#error').isHidden(), true, await page.locator('#error').textContent());
  assert.equal(await page.locator('.joint.edited').count(), 1);
  const glb = await readFile(await save(page, 'saveGlb'));
  await promisify(execFile)(infer, [drawing('gingerbread')[1], '--skeleton', path, '-o', scratch + '/again', '--formats', 'json,glb']);
  const again = await jsonOf(scratch + '/again/gingerbread.skeleton.json');
  assert.deepEqual(again.joints.map((joint) => joint.image), mended.joints.map((joint) => joint.image));
  const native = await readFile(scratch + '/again/gingerbread.glb');
  assert.ok(Math.abs(native.length - glb.length) < 0.02 * native.length);
});

step('the mask is painted', async () => {
  await drop(page, drawing('gingerbread'));
  await page.click('button[data-tool="erase"]');
  const box = await page.locator('#stage').boundingBox();
  const [x, y] = await jointPlace(page, 'left_hand');
  await page.mouse.move(x, y - 15);
  await page.mouse.down();
  await page.mouse.move(Math.min(x + 15, box.x + box.width - 5), y + 15, { steps: 4 });
  await page.mouse.up();
  await page.waitForSelector('#undo:enabled');
  await idle(page);
  await shot(page, 'mask.png');
  const path = await save(page, 'saveSkeleton');
  const files = unzipSync(await readFile(path));
  assert.deepEqual(Object.keys(files).sort(), ['gingerbread.mask.png', 'gingerbread.skeleton.json']);
  await mkdir(scratch + '/masked', { recursive: true });
  for (const [name, bytes] of Object.entries(files)) await writeFile(`${scratch}/masked/${name}`, bytes);
  await promisify(execFile)(infer, [drawing('gingerbread')[1], '--skeleton', `${scratch}/masked/gingerbread.skeleton.json`, '-o', scratch + '/masked-out']);
  const dropped = Object.entries(files).map(([name, bytes]) => [name, Buffer.from(bytes)]);
  await drop(page, drawing('gingerbread'), ...dropped);
  assert.equal(await page.locator('#error').isHidden(), true, await page.locator('#error').textContent());

  // Of files that do not belong together, one sentence, and what was there stays.
  const [skeleton] = dropped.filter(([name]) => name.endsWith('.json'));
  for (const [mask, words] of [
    [drawing('gingerbread.mask'), 'gingerbread.mask.png: has changed since gingerbread.skeleton.json was made with it'],
    [[, join(root, 'tests/fuzz/seeds/image/grey1.png')], 'gingerbread.mask.png: is a mask of 20x5 px'],
  ]) {
    await drop(page, drawing('gingerbread'), skeleton, ['gingerbread.mask.png', mask[1]]);
    assert.ok((await page.locator('#error').textContent()).startsWith(words), await page.locator('#error').textContent());
  }
  await page.click('button[data-tool="joints"]');
});

step('clips play, and stop', async () => {
  const look = () => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => resolve(document.getElementById('view').toDataURL()))));
  await page.selectOption('#clip', 'dance');
  const first = await look();
  await page.waitForTimeout(400);
  assert.notEqual(await look(), first);
  await page.click('#play');
  await page.waitForTimeout(1500); // the damped camera comes to rest
  const still = await look();
  await page.waitForTimeout(300);
  assert.equal(await look(), still);
  await page.click('#play');
});

step('the drawing itself moves, and the model comes back', async () => {
  const look = () => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => resolve(document.getElementById('view').toDataURL()))));
  await page.click('#play');
  await page.waitForTimeout(1500);
  const solid = await look();
  await page.selectOption('#look', 'flat');
  await idle(page);
  const flat = await look();
  assert.notEqual(flat, solid);
  assert.equal(await page.locator('#turn').isDisabled(), true);
  await page.click('#play');
  await page.waitForTimeout(400);
  assert.notEqual(await look(), flat);
  await shot(page, 'flat.png');
  await page.selectOption('#clip', 'wave');
  await idle(page);
  await page.waitForTimeout(300);
  await shot(page, 'flat-wave.png');
  await drop(page, drawing('cap_boy'));
  await page.waitForTimeout(300);
  await shot(page, 'flat-boy.png');
  assert.equal(await page.locator('#error').isHidden(), true, await page.locator('#error').textContent());
  const frames = unzipSync(await readFile(await save(page, 'saveFrames')));
  assert.notDeepEqual(frames['wave_01.png'], frames['wave_08.png']);
  await page.selectOption('#look', 'solid');
  await drop(page, drawing('gingerbread'));
  await page.selectOption('#clip', 'dance');
  assert.equal(await page.locator('#turn').isDisabled(), false);
});

step('film, sprite sheet, frames and texture are saved', async () => {
  const film = await readFile(await save(page, 'saveFilm'));
  assert.ok(film.length > 5000 && (film.subarray(0, 4).toString('hex') === '1a45dfa3' || film.subarray(4, 8).toString() === 'ftyp'));
  for (const [button, width] of [['saveSheet', 6 * 256], ['saveTexture', null]]) {
    const png = await readFile(await save(page, button));
    assert.equal(png.subarray(1, 4).toString(), 'PNG');
    if (width) assert.equal(png.readUInt32BE(16), width);
    if (width) await writeFile(join(shots, 'sheet.png'), png);
  }
  const frames = unzipSync(await readFile(await save(page, 'saveFrames')));
  assert.equal(Object.keys(frames).length, 24);
  assert.notDeepEqual(frames['dance_01.png'], frames['dance_08.png']);
});

step('an animal is seen to be one', async () => {
  await page.click('[data-sample="walking_fox"]');
  await page.waitForTimeout(50);
  await idle(page);
  assert.equal(await page.evaluate(() => document.body.dataset.plan), 'quadruped');
  await shot(page, 'fox.png');
});

step('bad input is told in one sentence, and the page goes on', async () => {
  for (const [name, bytes, words] of [
    ['notes.txt', Buffer.from('no picture'), 'notes.txt: is not a picture that can be read'],
    ['empty.png', Buffer.alloc(0), 'empty.png: is empty'],
    ['half.png', (await readFile(drawing('gingerbread')[1])).subarray(0, 2000), 'half.png: is a broken PNG'],
    ['broken.skeleton.json', Buffer.from('{'), 'broken.skeleton.json: is not JSON'],
  ]) {
    await drop(page, [name, bytes]);
    assert.ok((await page.locator('#error').textContent()).startsWith(words), await page.locator('#error').textContent());
    if (name === 'notes.txt') await shot(page, 'error.png');
  }
  await drop(page, drawing('alien'));
  assert.equal(await page.locator('#error').isHidden(), true);
});

step('a photo of 12 megapixels is taken', async () => {
  const photo = await page.evaluate(async () => {
    const image = new Image();
    image.src = document.querySelector('[data-sample="box_robot"] img').src;
    await image.decode();
    const canvas = new OffscreenCanvas(4000, 3000), context = canvas.getContext('2d');
    context.fillStyle = '#f4f1ea';
    context.fillRect(0, 0, 4000, 3000);
    context.drawImage(image, 700, 200, 2600, 2600);
    const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg', quality: 0.9 })).arrayBuffer());
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  });
  await drop(page, ['photo.jpg', Buffer.from(photo, 'base64')]);
  assert.equal(await page.locator('#error').isHidden(), true, await page.locator('#error').textContent());
  assert.match(await page.locator('#status').textContent(), /2048 × 1536/);
});

step('many drawings become one ZIP', async () => {
  await drop(page, drawing('alien'), drawing('gingerbread'), ['notes.png', Buffer.from('no picture')]);
  await page.waitForSelector('#save-all:enabled');
  assert.equal(await page.locator('#thumbnails button').count(), 3);
  const files = unzipSync(await readFile(await save(page, 'save-all')));
  assert.deepEqual(Object.keys(files).sort(), ['alien.glb', 'alien.skeleton.json', 'gingerbread.glb', 'gingerbread.skeleton.json']);
  await page.locator('#many').scrollIntoViewIfNeeded();
  await shot(page, 'many.png');
});

step('the page speaks German', async () => {
  await page.selectOption('#language', 'de');
  assert.equal(await page.locator('#choose-title').textContent(), '1 · Zeichnung wählen');
  assert.equal(await page.evaluate(() => document.documentElement.lang), 'de');
});

step('no script failed', async () => assert.deepEqual(page.problems, []));

step('it fits a phone', async () => {
  const phone = await openPage(browser, { width: 390, height: 844, hasTouch: true, isMobile: browserName === 'chromium', deviceScaleFactor: 2 });
  await phone.tap('[data-sample="gingerbread"]');
  await phone.waitForSelector('#skeleton:not([hidden])');
  await idle(phone);
  await phone.waitForTimeout(1000);
  assert.ok(await phone.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await shot(phone, 'phone.png');
  await phone.context().close();
});

step('without WebGL the skeleton can be mended', async () => {
  const plain = await launch({ webgl: false });
  const flat = await openPage(plain);
  await drop(flat, drawing('gingerbread'));
  assert.equal(await flat.locator('#no-webgl').isVisible(), true);
  assert.equal((await jsonOf(await save(flat, 'saveSkeleton'))).joints.length, 17);
  assert.equal((await readFile(await save(flat, 'saveGlb'))).subarray(0, 4).toString(), 'glTF');
  await plain.close();
});

if (browserName === 'chromium') step('a browser without SIMD is told so in one sentence', async () => {
  const old = await launch({ simd: false });
  const refused = await openPage(old, { runs: false });
  for (const sample of [null, 'gingerbread']) {
    if (sample) await refused.click(`[data-sample="${sample}"]`);
    await refused.waitForSelector('#error:not([hidden])');
    assert.match(await refused.locator('#error').textContent(), /^This browser is too old for skel/);
    assert.equal(await refused.locator('#skeleton').isHidden(), true);
  }
  assert.deepEqual(refused.problems, []);
  await old.close();
});

step('the hosted page works offline after the first visit', async () => {
  const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml', '.png': 'image/png', '.webmanifest': 'application/manifest+json' };
  const server = createServer(async (request, response) => {
    const path = new URL(request.url, 'http://localhost').pathname.replace(/\/$/, '/index.html');
    const bytes = await readFile(join(out, 'site', path)).catch(() => null);
    response.writeHead(bytes ? 200 : 404, { 'content-type': types[extname(path)] ?? 'text/plain' });
    response.end(bytes ?? '');
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const url = `http://127.0.0.1:${server.address().port}/`;
  const hosted = await openPage(browser, { url });
  await hosted.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
  await hosted.waitForTimeout(1000);
  server.closeAllConnections();
  await new Promise((resolve) => server.close(resolve));
  await hosted.reload();
  await hosted.waitForSelector('body[data-ready]');
  await drop(hosted, drawing('alien'));
  assert.equal(await hosted.locator('.joint').count(), 17);
  await hosted.context().close();
});

let failed = 0;
const only = process.env.STEP;
for (const [name, run] of steps) {
  if (only && !name.includes(only)) continue;
  try {
    await run();
    console.log(`ok    ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED ${name}: ${error.message}`);
    await shot(page, `failed-${failed}.png`).catch(() => {});
  }
}
await browser.close();
process.exit(failed ? 1 : 0);
