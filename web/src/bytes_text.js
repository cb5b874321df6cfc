// Bytes as text that an HTML file can hold: 7 bits a character, so 8/7 of their size in UTF-8 (base64: 4/3), after
// base122 (K. Albertson). A character that HTML would change, or that may end a script, takes the 7 bits that follow
// with it: its number among them, from 1, and those.
const kBarred = [0, 13, 60]; // NUL, carriage return, <
const kEnd = 127; // is none of them

export function textOfBytes(bytes) {
  const units = []; // of 7 bits
  let bits = 0, count = 0;
  for (const byte of bytes) {
    bits = (bits << 8 | byte) & 0x7fff;
    for (count += 8; count >= 7; count -= 7) units.push(bits >> (count - 7) & 127);
  }
  if (count) units.push(bits << (7 - count) & 127);
  units.push(kEnd);
  let text = '';
  for (let i = 0; i < units.length; ++i) {
    const number = kBarred.indexOf(units[i]) + 1;
    text += String.fromCharCode(number ? number << 7 | units[++i] : units[i]);
  }
  return text;
}

export function bytesOfText(text) {
  const bytes = new Uint8Array(2 * text.length);
  let units = 0, size = 0, bits = 0, count = 0;
  for (let i = 0; i < text.length; ++i) {
    const code = text.charCodeAt(i);
    if (code > 127) {
      bits = bits << 7 | kBarred[(code >> 7) - 1];
      count += 7;
      ++units;
    }
    bits = bits << 7 | code & 127;
    count += 7;
    ++units;
    for (; count >= 8; count -= 8) bytes[size++] = bits >> (count - 8);
  }
  return bytes.subarray(0, 7 * (units - 1) >> 3);
}
