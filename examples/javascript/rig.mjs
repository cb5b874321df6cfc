// node rig.mjs DRAWING.png OUT.glb: rigs a drawing, lifts its left hand and rigs it again with the skeleton so mended.
import { readFile, writeFile } from 'node:fs/promises';
import { basename } from 'node:path';
import { rig, SkelError } from 'skel';

const [file, out] = process.argv.slice(2);
try {
  const drawing = await readFile(file), name = basename(file);
  const { skeleton, plan, confidence, warnings } = await rig(drawing, { name });
  console.log(`${name}: ${plan}, confidence ${confidence.toFixed(2)}`);
  for (const warning of warnings) console.log(`  ${warning}`);

  const hand = skeleton.joints.find((joint) => joint.name === 'left_hand');
  if (hand) {
    hand.image[1] -= 5; // px
    hand.origin = 'edited';
  }
  const mended = await rig(drawing, { name, skeleton });
  await writeFile(out, mended.glb);
} catch (error) {
  if (!(error instanceof SkelError)) throw error;
  console.error(error.message);
  process.exit(2);
}
