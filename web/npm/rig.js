// What node and browsers have in common: `load(file)` gives the bytes of a file of this package, `createSkel` is the core.
import { Skel, SkelError } from '../src/skel.js';

const kNets = { page: 'page_net', parts: 'part_net', biped: 'joint_net', quadruped: 'quadruped_joint_net' };

async function bytesOf(data) {
  if (data instanceof Uint8Array) return data;
  return new Uint8Array(data instanceof ArrayBuffer ? data : await data.arrayBuffer()); // of a Blob, File or Response
}

export function rigBy(createSkel, load) {
  let started;
  const start = async () => {
    const [wasm, ...nets] = await Promise.all(['skel.wasm', ...Object.values(kNets).map((net) => `nets/${net}.bin`)].map(load));
    return Skel.start(createSkel, wasm, Object.fromEntries(Object.keys(kNets).map((net, i) => [net, nets[i]])));
  };

  return async function rig(drawing, { name = 'drawing.png', plan = 'auto', figure = 1, mask = null, skeleton = null } = {}) {
    started ??= start();
    let skel;
    try {
      skel = await started;
    } catch (error) {
      started = undefined; // a download that failed may succeed the next time
      throw error;
    }
    try {
      const picture = drawing.rgba ? { name, scaled: false, ...drawing } : await skel.open(await bytesOf(drawing), name);
      const maskPixels = mask && skel.readMask(picture, { bytes: await bytesOf(mask), file: 'the mask' });
      const text = skeleton && (typeof skeleton === 'string' ? skeleton : JSON.stringify(skeleton));
      const found = skel.rig(picture, {
        mask: maskPixels, plan: plan === 'auto' ? '' : plan, figure, skeleton: text, skeletonFile: text ? 'the skeleton' : '',
      });
      return {
        name: picture.name, width: picture.width, height: picture.height, scaled: picture.scaled,
        plan: found.plan, confidence: found.confidence, warnings: found.warnings, figures: found.figures,
        skeleton: JSON.parse(found.skeleton), mask: found.mask, times_ms: found.times, glb: skel.glb(), texture: skel.texture(),
      };
    } catch (error) {
      if (!(error instanceof SkelError)) started = undefined; // a core that has crashed is started anew
      throw error;
    }
  };
}
