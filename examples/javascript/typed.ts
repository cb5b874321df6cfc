// What TypeScript knows of the package.
import { readFile, writeFile } from 'node:fs/promises';
import { rig, SkelError, type Character } from 'skel';
import { startWorker } from 'skel/worker';
import 'skel/element';

export async function handOf(drawing: Blob): Promise<[number, number] | undefined> {
  const character: Character = await rig(drawing, { plan: 'biped' });
  return character.skeleton.joints.find(({ name }) => name === 'left_hand')?.image;
}

export async function save(drawing: string, model: string): Promise<Blob> {
  const { glb } = await rig(await readFile(drawing), { name: drawing });
  await writeFile(model, glb);
  return new Blob([glb], { type: 'model/gltf-binary' });
}

export const rigPixels = ({ width, height, data }: ImageData): Promise<Character> => rig({ width, height, rgba: data });

export function play(element: HTMLElement): void {
  const drawing = document.createElement('skel-drawing');
  drawing.clip = 'walk';
  drawing.addEventListener('rigged', ({ detail }) => console.log(detail.glb.byteLength, drawing.clips));
  drawing.addEventListener('error', ({ detail }) => console.log(detail.message));
  element.append(drawing);
}

export const worker = startWorker();
export const sentence = (error: unknown): string => (error instanceof SkelError ? error.message : String(error));
