// Puts the page and the npm package together: node build.mjs WASM_DIR OUT. OUT/skel.html is the whole page in one file,
// OUT/site the same as files to be hosted, OUT/npm the package. WASM_DIR holds skel.js and skel.wasm.
import { createHash } from 'node:crypto';
import { cp, mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';
import { zipSync } from 'fflate';
import { textOfBytes } from './src/bytes_text.js';

const [wasmDir, out] = process.argv.slice(2);
const here = new URL('.', import.meta.url).pathname;
const site = `${out}/site`;
const weights = { page: 'page_net', parts: 'part_net', biped: 'joint_net', quadruped: 'quadruped_joint_net' };
const samples = { gingerbread: 'characters', box_robot: 'characters', walking_fox: 'animals' };

const common = {
  bundle: true, target: 'es2022', legalComments: 'none', alias: { 'skel-core': `${wasmDir}/skel.js` }, external: ['fs', 'path', 'crypto'],
};

async function bundle(entry) {
  const { outputFiles } = await build({ ...common, entryPoints: [here + entry], minify: true, write: false, format: 'iife', platform: 'browser' });
  return outputFiles[0].text;
}

const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
const licences = JSON.parse(await readFile(`${here}/credits.json`, 'utf8'));
const credits = '<ul>' + licences.map(({ name, url, licence }) => `<li><a href="${url}">${name}</a> · ${licence}</li>`).join('') + '</ul>';
const inScript = (text) => text.replaceAll('</script', '<\\/script');

const [html, css, page, worker, wasm, licence] = await Promise.all([
  readFile(`${here}/index.html`, 'utf8'), readFile(`${here}/src/style.css`, 'utf8'), bundle('src/main.js'), bundle('src/worker.js'),
  readFile(`${wasmDir}/skel.wasm`), readFile(`${here}/../LICENSE`, 'utf8'),
]);
const body = html.replace('<!-- credits -->', () => `${credits}\n<pre>${escaped(licence)}</pre>`);

const pictures = {};
for (const [name, set] of Object.entries(samples)) pictures[name] = await readFile(`${here}/../datasets/${set}/${name}.png`);

const nets = {};
for (const [name, file] of Object.entries(weights)) nets[name] = new Uint8Array(await readFile(`${here}/../weights/${file}.bin`));
const netsZip = zipSync(nets, { level: 9, mtime: '1980-01-01' });

// One file: a worker cannot be loaded from file://, nor can a .wasm be fetched.
const packed = gzipSync(wasm, { level: 9 });
const asData = Object.fromEntries(Object.entries(pictures).map(([name, bytes]) => [name, `data:image/png;base64,${bytes.toString('base64')}`]));
await mkdir(`${site}/samples`, { recursive: true });
const single = body
  .replace('<!-- head -->', () => `<style>${css}</style>`)
  .replace('<!-- scripts -->', () => `<script>globalThis.skelSamples = ${JSON.stringify(asData)};</script>
<script type="text/plain" id="skel-worker">${inScript(worker)}</script>
<script type="text/plain" id="skel.wasm">${textOfBytes(packed)}</script>
<script type="text/plain" id="nets.zip">${textOfBytes(netsZip)}</script>
<script>${inScript(page)}</script>`);
await writeFile(`${out}/skel.html`, single);

// Files for a server, with what makes it an app that works offline.
const version = createHash('sha256').update(page).update(worker).update(wasm).update(netsZip).update(css).update(body).digest('hex').slice(0, 12);
const index = body
  .replace('<!-- head -->', () => '<link rel="stylesheet" href="style.css">\n<link rel="manifest" href="manifest.webmanifest">\n<link rel="icon" href="icon.svg">\n<meta name="theme-color" content="#2257c5">')
  .replace('<!-- scripts -->', () => '<script src="page.js"></script>');
const files = ['./', 'style.css', 'page.js', 'worker.js', 'skel.wasm', 'nets.zip', 'manifest.webmanifest', 'icon.svg', ...Object.keys(pictures).map((name) => `samples/${name}.png`)];
const serviceWorker = (await readFile(`${here}/src/sw.js`, 'utf8')).replace('VERSION', version).replace('FILES', JSON.stringify(files));
await Promise.all([
  writeFile(`${site}/index.html`, index), writeFile(`${site}/style.css`, css), writeFile(`${site}/page.js`, page),
  writeFile(`${site}/worker.js`, worker), writeFile(`${site}/skel.wasm`, wasm), writeFile(`${site}/nets.zip`, netsZip), writeFile(`${site}/sw.js`, serviceWorker),
  cp(`${here}/src/manifest.webmanifest`, `${site}/manifest.webmanifest`), cp(`${here}/src/icon.svg`, `${site}/icon.svg`),
  ...Object.entries(pictures).map(([name, bytes]) => writeFile(`${site}/samples/${name}.png`, bytes)),
]);

// The package for npm: modules that share what they have in common, so that a SkelError is one wherever it is imported from.
const npm = `${out}/npm`;
await rm(npm, { recursive: true, force: true });
await mkdir(`${npm}/nets`, { recursive: true });
const [cmake, described] = await Promise.all([readFile(`${here}/../CMakeLists.txt`, 'utf8'), readFile(`${here}/npm/package.json`, 'utf8')]);
await Promise.all([
  build({
    ...common, entryPoints: ['browser', 'node', 'worker', 'worker-thread', 'element'].map((name) => `${here}npm/${name}.js`), outdir: npm, splitting: true,
    format: 'esm', platform: 'browser', external: [...common.external, 'three', 'three/*', 'node:*'],
  }),
  writeFile(`${npm}/package.json`, JSON.stringify({ ...JSON.parse(described), version: cmake.match(/project\(skel VERSION ([\d.]+)/)[1] }, null, 2) + '\n'),
  writeFile(`${npm}/LICENSE`, licence + licences.map(({ name, url, licence: terms }) => `\n${name} (${url}): ${terms}`).join('') + '\n'),
  cp(`${wasmDir}/skel.js`, `${npm}/skel-core.cjs`), cp(`${wasmDir}/skel.wasm`, `${npm}/skel.wasm`),
  ...['README.md', 'index.d.ts', 'worker.d.ts', 'element.d.ts'].map((file) => cp(`${here}npm/${file}`, `${npm}/${file}`)),
  ...Object.values(weights).map((file) => cp(`${here}/../weights/${file}.bin`, `${npm}/nets/${file}.bin`)),
]);

const kB = (bytes) => `${Math.round(bytes / 1000)} kB`;
console.log(`skel.wasm ${kB(wasm.length)}, ${kB(packed.length)} gzipped; nets.zip ${kB(netsZip.length)}; skel.html ${kB(Buffer.byteLength(single))}`);
