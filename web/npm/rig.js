// What node and browsers have in common: `load(file)` gives the bytes of a file of this package, `createSkel` is the core.
import { Skel, SkelError } from '../src/skel.js';
import { bytesOf, checkedGiven } from './given.js';

const kNets = { page: 'page_net', parts: 'part_net', biped: 'joint_net', quadruped: 'quadruped_joint_net' };

export function rigBy(createSkel, load) {
  let started;
  const start = async () => {
    const [wasm, ...nets] = await Promise.all(['skel.wasm', ...Object.values(kNets).map((net) => `nets/${net}.bin`)].map(load));
    return Skel.start(createSkel, wasm, Object.fromEntries(Object.keys(kNets).map((net, i) => [net, nets[i]])));
  };

  return async function rig(drawing, options) {
    const given = checkedGiven(drawing, options);
    const mine = started ??= start();
    try {
      return await rigged(await mine, given);
    } catch (error) {
      // A download that failed may succeed the next time; a core that has crashed is started anew, once.
      if (!(error instanceof SkelError) && started === mine) started = undefined;
      throw error;
    }
  };
}

async function rigged(skel, { drawing, name, plan, figure, mask, skeleton }) {
  const picture = drawing.rgba ? { name, width: drawing.width, height: drawing.height, rgba: drawing.rgba, scaled: false } :
    await skel.open(await bytesOf(drawing, name), name);
  const maskBytes = mask && await bytesOf(mask, 'the mask');
  // From here on nothing waits: the core holds one character at a time.
  const found = skel.rig(picture, {
    mask: maskBytes && skel.readMask(picture, { bytes: maskBytes, file: 'the mask' }), plan: plan === 'auto' ? '' : plan, figure: figure ?? 1,
    skeleton, skeletonFile: skeleton === null ? '' : 'the skeleton',
  });
  const file = JSON.parse(found.skeleton);
  // A skeleton says itself whose it is.
  for (const [option, asked, has] of [['plan', plan === 'auto' ? undefined : plan, found.plan], ['figure', figure, file.figure.number]])
    if (asked !== undefined && asked !== has) throw new SkelError(`${option}: is ${asked}, the skeleton is of ${option} ${has}; leave one of them out`);
  return {
    name: picture.name, width: picture.width, height: picture.height, scaled: picture.scaled,
    plan: found.plan, confidence: found.confidence, warnings: found.warnings, figures: found.figures,
    skeleton: file, mask: found.mask, times_ms: found.times, glb: skel.glb(), texture: skel.texture(),
  };
}
