// The drawing with its mask and its skeleton. Joints are SVG, so that they can be dragged, focused and read out; the
// mask is a canvas that a brush paints on. Coordinates are image px: (0, 0) is the centre of the top left pixel.
import { say } from './words.js';

const kSvg = 'http://www.w3.org/2000/svg';
const kDot_px = 4.5, kGrip_px = 15; // at least, on the screen
const kSure = 0.5; // below, a joint stands where the rest of the figure suggests

const element = (name, attributes) => {
  const made = document.createElementNS(kSvg, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
};

export const spoken = (joint) => joint.replaceAll('_', ' ');

export class DrawingStage extends EventTarget {
  // `stage` holds a canvas.drawing, a canvas.mask and an svg.
  constructor(stage) {
    super();
    this.stage = stage;
    this.drawing = stage.querySelector('canvas.drawing');
    this.maskCanvas = stage.querySelector('canvas.mask');
    this.svg = stage.querySelector('svg');
    this.tool = 'joints';
    this.brush = 12;
    stage.addEventListener('pointerdown', (event) => this.#startPainting(event));
  }

  showPicture({ width, height, rgba }) {
    this.width = width;
    this.height = height;
    this.stage.style.aspectRatio = `${width} / ${height}`;
    this.stage.style.setProperty('--ratio', width / height);
    for (const canvas of [this.drawing, this.maskCanvas]) Object.assign(canvas, { width, height });
    this.drawing.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(rgba), width, height), 0, 0);
    this.svg.setAttribute('viewBox', `-0.5 -0.5 ${width} ${height}`);
    this.svg.replaceChildren();
  }

  // What is not the figure is veiled.
  showMask(mask) {
    this.mask = mask;
    const veil = new ImageData(this.width, this.height);
    for (let i = 0; i < mask.length; ++i) {
      if (mask[i]) continue;
      veil.data.set([232, 238, 250, 190], 4 * i);
    }
    this.maskCanvas.getContext('2d').putImageData(veil, 0, 0);
  }

  // `skeleton` is a parsed skeleton file. Joints keep their elements, and so the focus.
  showSkeleton(skeleton) {
    this.skeleton = skeleton;
    const longSide = Math.max(this.width, this.height);
    const cssPixel = this.width / (this.stage.clientWidth || this.width);
    const size = Math.max(longSide / 100, kDot_px * cssPixel), grip = Math.max(longSide / 40, kGrip_px * cssPixel);
    const names = skeleton.joints.map((joint) => joint.name).join();
    if (this.names !== names || !this.svg.firstChild) {
      this.names = names;
      this.svg.replaceChildren(element('g', { class: 'bones' }), element('g', { class: 'joints' }));
      for (const joint of skeleton.joints) {
        const group = element('g', { class: 'joint', tabindex: 0, role: 'button', 'data-joint': joint.name });
        group.append(element('circle', { class: 'grip', r: grip }), element('circle', { class: 'dot', r: size }));
        group.addEventListener('pointerdown', (event) => this.#startDragging(event, joint.name));
        group.addEventListener('keydown', (event) => this.#nudge(event, joint.name));
        this.svg.lastChild.append(group);
      }
    }
    const byName = new Map(skeleton.joints.map((joint) => [joint.name, joint]));
    this.svg.firstChild.replaceChildren(...skeleton.joints.filter((joint) => joint.parent).map((joint) => {
      const [x1, y1] = byName.get(joint.parent).image, [x2, y2] = joint.image;
      return element('line', { x1, y1, x2, y2, 'stroke-width': size * 0.7 });
    }));
    for (const group of this.svg.lastChild.children) {
      const joint = byName.get(group.dataset.joint);
      group.setAttribute('transform', `translate(${joint.image[0]} ${joint.image[1]})`);
      group.classList.toggle('unsure', joint.origin !== 'edited' && joint.confidence < kSure);
      group.classList.toggle('edited', joint.origin === 'edited');
      group.setAttribute('aria-label', say('jointLabel', spoken(joint.name), Math.round(100 * joint.confidence)));
    }
  }

  useTool(tool) {
    this.tool = tool;
    this.stage.dataset.tool = tool;
  }

  #point(event) {
    const box = this.stage.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width * this.width - 0.5, (event.clientY - box.top) / box.height * this.height - 0.5];
  }

  #move(name, x, y, done) {
    const joint = this.skeleton.joints.find((one) => one.name === name);
    const inside = (value, size) => Math.round(100 * Math.min(size - 1, Math.max(0, value))) / 100;
    joint.image = [inside(x, this.width), inside(y, this.height)];
    joint.origin = 'edited';
    joint.confidence = 1;
    this.skeleton.missing = this.skeleton.missing.filter((one) => one !== name);
    this.showSkeleton(this.skeleton);
    this.dispatchEvent(new CustomEvent('skeleton', { detail: { skeleton: this.skeleton, done } }));
  }

  #startDragging(event, name) {
    if (this.tool !== 'joints' || event.button > 0) return;
    event.stopPropagation();
    const group = event.currentTarget;
    group.focus({ preventScroll: true });
    group.setPointerCapture(event.pointerId);
    const joint = this.skeleton.joints.find((one) => one.name === name);
    const start = this.#point(event), from = joint.image;
    let moved = false;
    const to = (move, done) => {
      const [x, y] = this.#point(move);
      this.#move(name, from[0] + x - start[0], from[1] + y - start[1], done);
    };
    const onMove = (move) => {
      moved = true;
      to(move, false);
    };
    const onEnd = (end) => {
      group.removeEventListener('pointermove', onMove);
      if (moved) to(end, true);
    };
    group.addEventListener('pointermove', onMove);
    group.addEventListener('lostpointercapture', onEnd, { once: true });
    event.preventDefault();
  }

  #nudge(event, name) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const size = Math.max(this.width, this.height) / (event.shiftKey ? 40 : 200);
    const [x, y] = this.skeleton.joints.find((joint) => joint.name === name).image;
    this.#move(name, x + step[0] * size, y + step[1] * size, true);
  }

  #startPainting(event) {
    if (this.tool === 'joints' || event.button > 0 || !this.mask) return;
    event.preventDefault();
    this.stage.setPointerCapture(event.pointerId);
    const value = this.tool === 'add' ? 255 : 0;
    const mask = this.mask.slice();
    const radius = this.brush * Math.max(this.width, this.height) / 600;
    let last = this.#point(event);
    const dab = (x, y) => {
      for (let v = Math.max(0, Math.ceil(y - radius)); v <= Math.min(this.height - 1, y + radius); ++v)
        for (let u = Math.max(0, Math.ceil(x - radius)); u <= Math.min(this.width - 1, x + radius); ++u)
          if ((u - x) ** 2 + (v - y) ** 2 <= radius ** 2) mask[v * this.width + u] = value;
    };
    const stroke = (move) => {
      const to = this.#point(move);
      const steps = Math.max(1, Math.ceil(Math.hypot(to[0] - last[0], to[1] - last[1]) / (radius / 2)));
      for (let i = 1; i <= steps; ++i) dab(last[0] + (to[0] - last[0]) * i / steps, last[1] + (to[1] - last[1]) * i / steps);
      last = to;
      this.showMask(mask);
    };
    stroke(event);
    this.stage.addEventListener('pointermove', stroke);
    this.stage.addEventListener('lostpointercapture', () => {
      this.stage.removeEventListener('pointermove', stroke);
      this.dispatchEvent(new CustomEvent('mask', { detail: mask }));
    }, { once: true });
  }
}
