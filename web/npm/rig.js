// What node and browsers have in common: `load(file)` gives the bytes of a file of this package, `createSkel` is the core.
import { Skel, SkelError } from '../src/skel.js';
import { bytesOf, checkedGiven, copied } from './given.js';

const kNets = { page: 'page_net', parts: 'part_net', biped: 'joint_net', quadruped: 'quadruped_joint_net' };

export function rigBy(createSkel, load) {
  let started;
  const start = async () => {
    const [wasm, ...nets] = await Promise.all(['skel.wasm', ...Object.values(kNets).map((net) => `nets/${net}.bin`)].map(load));
    return Skel.start(createSkel, wasm, Object.fromEntries(Object.keys(kNets).map((net, i) => [net, nets[i]])));
  };

  return async function rig(drawing, options) {
    const given = checkedGiven(drawing, options);
    given.drawing = copied(given.drawing);
    given.mask = copied(given.mask);
    const mine = started ??= start();
    try {
      const skel = await mine;
      await turn();
      return await rigged(skel, given);
    } catch (error) {
      // A download that failed may succeed the next time; a core that has crashed is started anew, once.
      if (!(error instanceof SkelError) && started === mine) started = undefined;
      throw error;
    }
  };
}

// Lets whatever else waits in this thread have its turn: one call after the other would leave it none.
const turn = () => new Promise((resolve) => {
  if (globalThis.setImmediate) {
    setImmediate(resolve);
    return;
  }
  const { port1, port2 } = new MessageChannel(); // sooner than setTimeout(), which pages in the background put off
  port1.onmessage = () => {
    port1.close();
    resolve();
  };
  port2.postMessage(null);
});

const saidHere = (warning) => warning.replace(/^the figure is turned by -?\d+ degrees$/, '$& (if it is not, use upright)');

async function rigged(skel, { drawing, name, plan, figure, upright, mask, skeleton }) {
  const picture = drawing.rgba ? { name, width: drawing.width, height: drawing.height, rgba: drawing.rgba, scaled: false } :
    await skel.open(await bytesOf(drawing, name), name);
  const maskBytes = mask && await bytesOf(mask, 'the mask');
  // From here on nothing waits: the core holds one character at a time.
  const found = skel.rig(picture, {
    mask: maskBytes && skel.readMask(picture, { bytes: maskBytes, file: 'the mask' }), plan: plan === 'auto' ? '' : plan, figure: figure ?? 1, upright,
    skeleton, skeletonFile: skeleton === null ? '' : 'the skeleton',
  });
  const file = JSON.parse(found.skeleton);
  // A skeleton says itself whose it is.
  for (const [option, asked, has] of [['plan', plan === 'auto' ? undefined : plan, found.plan], ['figure', figure, file.figure.number]])
    if (asked !== undefined && asked !== has) throw new SkelError(`${option}: is ${asked}, the skeleton is of ${option} ${has}; leave one of them out`);
  return {
    name: picture.name, width: picture.width, height: picture.height, scaled: picture.scaled,
    plan: found.plan, confidence: found.confidence, warnings: found.warnings.map(saidHere), figures: found.figures,
    skeleton: file, mask: found.mask, times_ms: found.times, glb: skel.glb(), texture: skel.texture(),
  };
}
