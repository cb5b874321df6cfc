// Files for the user.
import { zip } from 'fflate';

export function download(name, data, type = 'application/octet-stream') {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(data instanceof Blob ? data : new Blob([data], { type }));
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

// `files`: {path: bytes}. Pictures and models are packed already.
export const zipOf = (files) => new Promise((resolve, reject) =>
  zip(files, { level: 0 }, (error, bytes) => (error ? reject(error) : resolve(bytes))));

export const pngOf = (canvas) => new Promise((resolve) => canvas.toBlob(resolve, 'image/png'));
export const bytesOf = async (blob) => new Uint8Array(await blob.arrayBuffer());
export const stemOf = (file) => file.replace(/\.[^.]*$/, '') || file;
