import { rig } from './browser.js';

let before = Promise.resolve();
onmessage = ({ data: { id, drawing, ...options } }) => {
  before = before.then(async () => {
    try {
      const character = await rig(drawing, options);
      postMessage({ id, character }, [character.glb.buffer, character.texture.buffer, character.mask.buffer]);
    } catch (error) {
      postMessage({ id, error: error.message ?? String(error), name: error.name });
    }
  });
};
