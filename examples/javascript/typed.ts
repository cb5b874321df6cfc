// What TypeScript knows of the package.
import { rig, SkelError, type Character } from 'skel';
import { startWorker } from 'skel/worker';
import 'skel/element';

export async function handOf(drawing: Blob): Promise<[number, number] | undefined> {
  const character: Character = await rig(drawing, { plan: 'biped' });
  return character.skeleton.joints.find(({ name }) => name === 'left_hand')?.image;
}

export function play(element: HTMLElement): void {
  const drawing = document.createElement('skel-drawing');
  drawing.clip = 'walk';
  drawing.addEventListener('rigged', ({ detail }) => console.log(detail.glb.byteLength, drawing.clips));
  element.append(drawing);
}

export const worker = startWorker();
export const sentence = (error: unknown): string => (error instanceof SkelError ? error.message : String(error));
