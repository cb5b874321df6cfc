import { core, start } from './core.js';
import { FlatFigure, kFlatRate_hz } from './flat_figure.js';
import { History } from './history.js';
import { bytesOf, download, pngOf, stemOf, zipOf } from './save.js';
import { DrawingStage } from './stage2d.js';
import { ModelStage } from './stage3d.js';
import { hasWord, languages, say, useLanguage } from './words.js';

const $ = (id) => document.getElementById(id);
const kFrames = 24, kFramePixels = 256, kSheetColumns = 6;
const kFirstClip = { biped: 'wave', quadruped: 'walk' };

// The drawing at work: its file, what was read of it, what was found.
let work = null; // {file, picture, mask (edited, or null), skeleton, plan, figure, glb}
const history = new History();
const drawing = new DrawingStage($('stage'));
let model = null;
let batch = []; // {name, files: {path: bytes}, source}

function busy(text) {
  $('status').textContent = text;
  $('status').classList.add('busy');
}
function calm(text = say('ready')) {
  $('status').textContent = text;
  $('status').classList.remove('busy');
}
async function complain(error) {
  if (error.fatal) {
    await start().then(reopen).catch(() => {});
    error = new Error(say('crashed', error.message));
  }
  $('error').textContent = error.message;
  $('error').hidden = false;
  calm('');
}

// One piece of work at a time, in the order in which they were asked for; what it complains of is shown.
let last = Promise.resolve();
const inTurn = (task) => (last = last.then(runsHere ? task : refuse).catch(complain));

// (module (func (result v128) i32.const 0 i8x16.splat))
const kSimd = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11]);
const runsHere = globalThis.WebAssembly && globalThis.OffscreenCanvas && WebAssembly.validate(kSimd);
function refuse() {
  throw new Error(say('tooOld'));
}

// --- from a file to a character -------------------------------------------------------------------------------

const isSkeleton = (file) => /\.json$/i.test(file.name);
const isMask = (file) => /\.mask\.png$/i.test(file.name);

async function open(file, extra = {}) {
  $('error').hidden = true;
  busy(say('reading'));
  const picture = await core.open(await bytesOf(file), file.name);
  const opened = { file, picture, mask: null, plan: '', figure: 1, ...extra };
  const joints = extra.skeletonFile ? { skeleton: await extra.skeletonFile.text(), skeletonFile: extra.skeletonFile.name } : {};
  let found;
  try {
    if (extra.maskFile) opened.mask = (await core.readMask({ ...joints, bytes: await bytesOf(extra.maskFile), file: extra.maskFile.name })).mask;
    busy(say('rigging'));
    found = await core.rig({ mask: opened.mask, plan: opened.plan, figure: opened.figure, ...joints });
  } catch (error) {
    if (!error.fatal) await reopen();
    throw error;
  }
  work = opened;
  $('plan').value = work.plan;
  document.querySelector('main').classList.add('working');
  for (const id of ['skeleton', 'model']) $(id).hidden = false;
  drawing.showPicture(picture);
  await show(found, false);
  history.reset(state());
  updateHistory();
  calm(picture.scaled ? say('scaled', picture.width, picture.height) : undefined);
}

// The core holds one drawing at a time: after another one, or a crash, back to the one at work.
async function reopen() {
  if (!work) return;
  await core.open(await bytesOf(work.file), work.file.name);
  await core.rig({ mask: work.mask, ...given(JSON.parse(work.skeleton)) });
}

async function show(found, keep) {
  work.skeleton = found.skeleton;
  drawing.showMask(found.mask);
  drawing.showSkeleton(JSON.parse(found.skeleton));
  $('confidence').value = found.confidence;
  $('confidence-text').textContent = say('confidence', Math.round(100 * found.confidence));
  $('warnings').replaceChildren(...found.warnings.map((warning) =>
    Object.assign(document.createElement('li'), { textContent: warning.replace(/ ?\(if it is not, use upright\)/, '') })));
  $('figure-label').hidden = found.figures < 2;
  $('figure').replaceChildren(...Array.from({ length: found.figures }, (_, i) => new Option(i + 1, i + 1)));
  $('figure').value = JSON.parse(found.skeleton).figure.number;
  document.body.dataset.plan = found.plan;
  if (!keep) busy(say('modelling'));
  work.glb = await core.glb();
  if (!model) return;
  if (!keep) model.clip = kFirstClip[found.plan];
  await model.show(work.glb, keep);
  $('clip').replaceChildren(new Option(say('rest'), ''), ...model.clips.map(({ name }) =>
    new Option(hasWord(`clip_${name}`) ? say(`clip_${name}`) : name, name)));
  $('clip').value = model.clip;
  await showLook();
}

// What the drawing itself looks like in the clip is made when it is asked for.
async function showLook() {
  const isFlat = $('look').value === 'flat';
  $('turn').disabled = isFlat;
  if (!isFlat) return model.showFlat(null);
  busy(say('cutting'));
  const figure = new FlatFigure(await core.flat());
  figure.use(await core.flatClip(model.clip, kFlatRate_hz));
  model.showFlat(figure);
}

// --- mending -----------------------------------------------------------------------------------------------------

const state = () => ({ skeleton: work.skeleton, mask: work.mask });
const isEdited = (skeleton) => JSON.parse(skeleton).joints.some((joint) => joint.origin === 'edited');

function updateHistory() {
  $('undo').disabled = !history.canUndo;
  $('redo').disabled = !history.canRedo;
  $('again').disabled = !history.canUndo;
}

// To go on from joints. The core gets the mask by itself.
const given = (skeleton) => ({
  skeleton: JSON.stringify({ ...skeleton, mask: null }), skeletonFile: `${stemOf(work.picture.name)}.skeleton.json`,
});

// While a joint is dragged, the newest place counts; those that came while the core was at work are left out. Drafts will
// do until it rests.
let wanted = null, running = false;
async function follow() {
  if (running) return;
  running = true;
  try {
    while (wanted) {
      const { skeleton, done } = wanted;
      wanted = null;
      const found = await core.rig({ mask: work.mask, draft: !done, ...given(skeleton) });
      work.skeleton = found.skeleton;
      if (wanted) continue;
      work.glb = await core.glb();
      await model?.show(work.glb, true);
      if (done && !wanted) {
        await show(found, true);
        history.push(state());
        updateHistory();
        calm();
      }
    }
    $('error').hidden = true;
  } catch (error) {
    wanted = null;
    drawing.showSkeleton(JSON.parse(work.skeleton)); // what cannot be is taken back
    if (!error.fatal) { // and no draft stays
      await core.rig({ mask: work.mask, ...given(JSON.parse(work.skeleton)) });
      work.glb = await core.glb();
      await model?.show(work.glb, true);
    }
    await complain(error);
  } finally {
    running = false;
  }
}

async function restore({ skeleton, mask }) {
  work.mask = mask;
  await show(await core.rig({ mask, ...given(JSON.parse(skeleton)) }), true);
  updateHistory();
}

drawing.addEventListener('skeleton', ({ detail: { skeleton, done } }) => {
  wanted = { skeleton: structuredClone(skeleton), done };
  follow();
});

drawing.addEventListener('mask', ({ detail: mask }) => inTurn(async () => {
  busy(say('rigging'));
  try {
    // Joints that somebody has placed stay; else they are found anew.
    const joints = isEdited(work.skeleton) ? given(JSON.parse(work.skeleton)) : {};
    const found = await core.rig({ mask, plan: work.plan, figure: work.figure, ...joints });
    work.mask = mask;
    $('error').hidden = true;
    await show(found, true);
    history.push(state());
    updateHistory();
    calm();
  } catch (error) {
    await restore(state());
    throw error;
  }
}));

for (const button of document.querySelectorAll('[data-tool]')) {
  if (button.tagName !== 'BUTTON') continue;
  button.onclick = () => {
    drawing.useTool(button.dataset.tool);
    for (const other of document.querySelectorAll('button[data-tool]')) other.setAttribute('aria-pressed', other === button);
    $('brush-label').hidden = drawing.tool === 'joints';
  };
}
$('brush').oninput = () => { drawing.brush = Number($('brush').value); };
$('undo').onclick = () => inTurn(() => history.canUndo && restore(history.undo()));
$('redo').onclick = () => inTurn(() => history.canRedo && restore(history.redo()));
$('again').onclick = () => inTurn(async () => {
  await restore(history.first);
  history.reset(state());
  updateHistory();
});
addEventListener('keydown', (event) => {
  if (!work || !(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== 'z') return;
  event.preventDefault();
  (event.shiftKey ? $('redo') : $('undo')).click();
});
for (const id of ['plan', 'figure'])
  $(id).onchange = () => inTurn(() => open(work.file, { plan: $('plan').value, figure: Number($('figure').value) || 1 }));

// --- the model ---------------------------------------------------------------------------------------------------

function startModel() {
  try {
    model = new ModelStage($('view'));
    model.playing = !matchMedia('(prefers-reduced-motion: reduce)').matches;
    updatePlay();
  } catch {
    $('view').hidden = true;
    $('no-webgl').hidden = false;
    document.querySelector('#model .tools').hidden = true;
    for (const key of ['saveFilm', 'saveSheet', 'saveFrames']) $(key).disabled = true;
  }
}

function updatePlay() {
  if (model) $('play').textContent = say(model.playing ? 'pause' : 'play');
}
$('clip').onchange = () => {
  if (!model.flat) return model.play($('clip').value);
  inTurn(async () => {
    const name = $('clip').value;
    model.flat.use(await core.flatClip(name, kFlatRate_hz));
    model.play(name);
  });
};
$('look').onchange = () => inTurn(async () => {
  await showLook();
  calm();
});
$('play').onclick = () => {
  model.playing = !model.playing;
  updatePlay();
};
$('turn').onclick = () => model.turn(Math.PI / 4);
$('view').onkeydown = (event) => {
  const by = { ArrowLeft: -0.2, ArrowRight: 0.2 }[event.key];
  if (!by) return;
  event.preventDefault();
  model.turn(by);
};

// --- saving ------------------------------------------------------------------------------------------------------

const stem = () => stemOf(work.picture.name);

// What skel-infer would have written beside the drawing, and the drawing itself where its pixels are no longer the file's.
async function skeletonFiles() {
  const files = { [`${stem()}.skeleton.json`]: new TextEncoder().encode(work.skeleton) };
  if (work.mask) files[`${stem()}.mask.png`] = await core.mask();
  if (work.picture.scaled) files[work.picture.name] = await core.drawing();
  return files;
}

async function drawFrames() {
  busy(say('drawingFrames'));
  const sheet = Object.assign(document.createElement('canvas'), {
    width: kSheetColumns * kFramePixels, height: kFrames / kSheetColumns * kFramePixels,
  });
  const frames = [];
  await model.pictures(kFrames, kFramePixels, async (canvas, i) => {
    sheet.getContext('2d').drawImage(canvas, i % kSheetColumns * kFramePixels, Math.floor(i / kSheetColumns) * kFramePixels);
    frames.push(await pngOf(canvas));
  });
  return { sheet, frames };
}

const savers = {
  saveGlb: async () => [`${stem()}.glb`, work.glb, 'model/gltf-binary'],
  saveFilm: async () => {
    busy(say('filming'));
    const film = await model.film();
    if (!film) throw new Error(say('noFilm'));
    return [`${stem()}-${model.clip || 'rest'}.${film.ending}`, film.blob];
  },
  saveSheet: async () => [`${stem()}-${model.clip || 'rest'}-sheet.png`, await pngOf((await drawFrames()).sheet)],
  saveFrames: async () => {
    const files = {};
    for (const [i, frame] of (await drawFrames()).frames.entries())
      files[`${model.clip || 'rest'}_${String(i + 1).padStart(2, '0')}.png`] = await bytesOf(frame);
    return [`${stem()}-${model.clip || 'rest'}.zip`, await zipOf(files), 'application/zip'];
  },
  saveSkeleton: async () => {
    const files = Object.entries(await skeletonFiles());
    if (files.length === 1) return [...files[0], 'application/json'];
    return [`${stem()}.skeleton.zip`, await zipOf(Object.fromEntries(files)), 'application/zip'];
  },
  saveTexture: async () => [`${stem()}.texture.png`, await core.texture(), 'image/png'],
};
for (const [key, make] of Object.entries(savers)) {
  const button = document.createElement('button');
  button.id = key;
  if (key === 'saveGlb') button.className = 'strong';
  for (const [tag, word] of [['b', key], ['small', `${key}Hint`]]) {
    const part = document.createElement(tag);
    part.dataset.word = word;
    button.append(part);
  }
  button.onclick = () => inTurn(async () => {
    const file = await make();
    download(...file);
    calm(say('saved', file[0]));
  });
  $('save').append(button);
}

// --- many drawings -----------------------------------------------------------------------------------------------

const kThumbnail = 200;

async function thumbnail(picture, skeleton) {
  const full = Object.assign(document.createElement('canvas'), { width: picture.width, height: picture.height });
  full.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(picture.rgba), picture.width, picture.height), 0, 0);
  const canvas = Object.assign(document.createElement('canvas'), { width: kThumbnail, height: kThumbnail });
  const context = canvas.getContext('2d');
  const scale = kThumbnail / Math.max(picture.width, picture.height);
  const left = (kThumbnail - picture.width * scale) / 2, top = (kThumbnail - picture.height * scale) / 2;
  context.fillStyle = '#fff';
  context.fillRect(0, 0, kThumbnail, kThumbnail);
  context.drawImage(full, left, top, picture.width * scale, picture.height * scale);
  context.strokeStyle = '#2257c5';
  context.lineWidth = 2;
  for (const joint of skeleton.joints) {
    const parent = skeleton.joints.find((one) => one.name === joint.parent);
    if (!parent) continue;
    context.beginPath();
    for (const { image: [x, y] } of [parent, joint]) context.lineTo(left + x * scale, top + y * scale);
    context.stroke();
  }
  return canvas;
}

async function rigMany(files) {
  batch = [];
  busy(say('rigging'));
  $('many').hidden = false;
  $('thumbnails').replaceChildren();
  $('save-all').disabled = true;
  for (const [i, file] of files.entries()) {
    $('many-progress').textContent = say('manyProgress', i, files.length);
    const tile = document.createElement('button');
    try {
      const picture = await core.open(await bytesOf(file), file.name);
      const found = await core.rig({});
      const name = stemOf(picture.name);
      const made = { [`${name}.glb`]: await core.glb(), [`${name}.skeleton.json`]: new TextEncoder().encode(found.skeleton) };
      if (picture.scaled) made[picture.name] = await core.drawing();
      batch.push(made);
      tile.append(await thumbnail(picture, JSON.parse(found.skeleton)), name, document.createElement('br'),
        `${Math.round(100 * found.confidence)} %`);
      tile.onclick = () => inTurn(() => open(file));
    } catch (error) {
      tile.className = 'failed';
      tile.disabled = true;
      tile.textContent = error.message;
      if (error.fatal) await start();
    }
    $('thumbnails').append(tile);
  }
  $('many-progress').textContent = say('manyProgress', files.length, files.length);
  $('save-all').disabled = batch.length === 0;
  await reopen();
  calm();
}
$('save-all').onclick = () => inTurn(async () => download('skel.zip', await zipOf(Object.assign({}, ...batch)), 'application/zip'));

// --- files that come in ---------------------------------------------------------------------------------------------

async function take(files) {
  const skeletons = files.filter(isSkeleton), masks = files.filter(isMask);
  const pictures = files.filter((file) => !isSkeleton(file) && !isMask(file));
  if (pictures.length > 1) return rigMany(pictures);
  const [skeletonFile] = skeletons, [maskFile] = masks;
  const file = pictures[0] ?? (skeletonFile || maskFile ? work?.file : null);
  if (!file) throw new Error(say('needsDrawing', (skeletonFile ?? maskFile).name));
  if (skeletonFile && !maskFile) {
    const { mask } = await skeletonFile.text().then(JSON.parse).catch(() => ({}));
    if (mask) throw new Error(say('needsMask', skeletonFile.name, mask.file));
  }
  return open(file, { skeletonFile, maskFile });
}
const takeFiles = (list) => {
  const files = [...list];
  if (!files.length) return;
  busy(say('reading'));
  inTurn(() => take(files));
};

for (const id of ['file', 'camera'])
  $(id).onchange = () => {
    takeFiles($(id).files);
    $(id).value = '';
  };
addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('over');
});
addEventListener('dragleave', (event) => event.relatedTarget ?? document.body.classList.remove('over'));
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('over');
  takeFiles(event.dataTransfer.files);
});
addEventListener('paste', (event) => takeFiles(event.clipboardData.files));

for (const [word, name] of [['sampleBiscuit', 'gingerbread'], ['sampleRobot', 'box_robot'], ['sampleFox', 'walking_fox']]) {
  const url = sampleUrl(name);
  const button = document.createElement('button');
  const label = document.createElement('span');
  label.dataset.word = word;
  button.append(Object.assign(document.createElement('img'), { src: url, alt: '' }), label);
  button.dataset.sample = name;
  button.onclick = () => {
    busy(say('reading'));
    inTurn(async () => open(new File([await bytesOfUrl(url)], `${name}.png`, { type: 'image/png' })));
  };
  $('samples').append(button);
}
function sampleUrl(name) {
  return globalThis.skelSamples?.[name] ?? `samples/${name}.png`;
}
async function bytesOfUrl(url) {
  return new Uint8Array(await (await fetch(url)).arrayBuffer());
}

// --- words, and off we go --------------------------------------------------------------------------------------------

function speak(code) {
  useLanguage(code);
  updatePlay();
  for (const option of $('clip').options) if (hasWord(`clip_${option.value}`)) option.textContent = say(`clip_${option.value}`);
  if (work) $('confidence-text').textContent = say('confidence', Math.round(100 * $('confidence').value));
}
for (const [code, name] of languages) $('language').append(new Option(name, code));
$('language').onchange = () => speak($('language').value);
$('language').value = languages.some(([code]) => navigator.language.startsWith(code)) ? navigator.language.slice(0, 2) : 'en';
speak($('language').value);

busy(say('starting'));
inTurn(async () => {
  await start();
  if (!work) calm('');
  document.body.dataset.ready = Math.round(performance.now());
});
inTurn(startModel);
// The first drawing takes some times as long as those after it: let it be one that nobody waits for.
inTurn(async () => {
  if (work) return;
  await core.open(await bytesOfUrl(sampleUrl('gingerbread')), 'gingerbread.png');
  await core.rig({ plan: 'biped' });
});
if ('serviceWorker' in navigator && location.protocol.startsWith('http')) navigator.serviceWorker.register('sw.js');
