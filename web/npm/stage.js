// The stages of all elements. One WebGL context draws them, one after the other, and each canvas takes its picture:
// browsers keep 16 contexts at most and take them from whoever has drawn longest ago.
import {
  AmbientLight, AnimationMixer, Box3, CircleGeometry, DirectionalLight, Mesh, MeshBasicMaterial, PerspectiveCamera, Scene, Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { addInkHull } from '../src/ink_hull.js';

const kPatience_ms = 2000; // with a browser that gives a lost context back
const kLongestStep_s = 0.1;
const kTurned = 0.35; // how far a new drawing is, rad

const stages = new Set(); // in the page
let renderer, lost, asked;

// Takes the place of one that is lost. Throws where there is no WebGL.
function startRenderer() {
  const made = new WebGLRenderer({ antialias: true, alpha: true });
  made.setPixelRatio(1);
  made.autoClear = false;
  const canvas = made.domElement;
  canvas.addEventListener('webglcontextlost', () => {
    lost = true;
    setTimeout(() => {
      if (lost && made === renderer) for (const stage of stages) stage.onlost(new Error('WebGL: the browser has taken the context away; does the page have too many?'));
    }, kPatience_ms);
  });
  canvas.addEventListener('webglcontextrestored', () => {
    if (made === renderer) found();
  });
  for (const stage of stages) stage.free();
  renderer?.dispose();
  renderer = made;
  found();
}

function found() {
  lost = false;
  for (const stage of stages) {
    stage.redraw();
    stage.onrestored();
  }
}

function drawAll(now) {
  asked = stages.size ? requestAnimationFrame(drawAll) : undefined;
  if (lost || renderer.getContext().isContextLost()) return; // what was drawn last stays
  for (const stage of stages) stage.draw(now);
}

export class DrawingStage {
  onlost = () => {}; // (error): the picture stands still
  onrestored = () => {};
  clips = [];
  #context;
  #scene = new Scene();
  #camera = new PerspectiveCamera(30, 1, 0.01, 100);
  #ground;
  #controls;
  #model;
  #mixer;
  #action;
  #center = new Vector3();
  #reach = 1;
  #sizes = new ResizeObserver(() => { this.#stale = true; });
  #views = new IntersectionObserver((seen) => { this.#seen = seen.at(-1).isIntersecting; });
  #seen = true;
  #stale = true; // what the canvas shows is not what there is
  #last;

  constructor(canvas) {
    this.canvas = canvas;
    this.#context = canvas.getContext('2d');
    const sun = new DirectionalLight(0xffffff, 1.1);
    sun.position.set(1, 2, 3);
    this.#scene.add(new AmbientLight(0xffffff, 2.3), sun);
    this.#ground = new Mesh(new CircleGeometry(1, 64).rotateX(-Math.PI / 2),
      new MeshBasicMaterial({ color: 0x7d8fb3, transparent: true, opacity: 0.18, depthWrite: false }));
    this.#scene.add(this.#ground);
    this.#ground.visible = false;
  }

  // From here on it is drawn. Throws where there is no WebGL.
  start() {
    if (!renderer || lost) startRenderer();
    stages.add(this);
    this.#controls = new OrbitControls(this.#camera, this.canvas);
    this.#controls.enablePan = false;
    this.#controls.enableDamping = true;
    this.#controls.target.copy(this.#center);
    this.#sizes.observe(this.canvas);
    this.#views.observe(this.canvas);
    this.redraw();
    asked ??= requestAnimationFrame(drawAll);
  }

  // Nothing holds it any more, here or on the graphics card; it may start again.
  stop() {
    stages.delete(this);
    this.#controls?.dispose();
    this.#controls = undefined;
    this.#sizes.disconnect();
    this.#views.disconnect();
    this.free();
  }

  free() {
    free(this.#scene);
  }

  redraw() {
    this.#stale = true;
  }

  // At `now`, if it can be seen and has changed.
  draw(now) {
    const step_s = Math.min(kLongestStep_s, (now - (this.#last ?? now)) / 1000);
    this.#last = now;
    if (!this.#seen) return;
    const size = this.#size();
    if (!size) return;
    const turned = this.#controls.update();
    if (!turned && !this.#stale && !this.#action) return;
    this.#mixer?.update(step_s);
    this.#stale = false;
    this.#paint(...size);
  }

  // Of the canvas, device px; undefined where it has none.
  #size() {
    const ratio = Math.min(2, devicePixelRatio), { canvas } = this;
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (!width || !height) return undefined;
    if (canvas.width !== width || canvas.height !== height) {
      Object.assign(canvas, { width, height });
      this.#camera.aspect = width / height;
      this.#camera.updateProjectionMatrix();
      this.#stale = true;
    }
    return [width, height];
  }

  #paint(width, height) {
    const from = renderer.domElement;
    if (from.width < width || from.height < height) renderer.setSize(Math.max(from.width, width), Math.max(from.height, height), false);
    renderer.setViewport(0, 0, width, height);
    renderer.setScissor(0, 0, width, height);
    renderer.setScissorTest(true);
    renderer.clear();
    renderer.render(this.#scene, this.#camera);
    this.#context.clearRect(0, 0, width, height);
    this.#context.drawImage(from, 0, from.height - height, width, height, 0, 0, width, height);
  }

  async show(glb) {
    const { scene, animations } = await new GLTFLoader().parseAsync(glb.buffer, '');
    if (lost && stages.size) startRenderer(); // somebody has asked: once more
    this.clear();
    this.#model = scene;
    this.clips = animations;
    addInkHull(scene);
    scene.traverse((part) => { part.frustumCulled = false; });
    this.#scene.add(scene);
    this.#mixer = new AnimationMixer(scene);
    const box = new Box3().setFromObject(scene), size = box.getSize(new Vector3());
    box.getCenter(this.#center);
    this.#reach = Math.max(size.x, size.y) * 0.5;
    this.#ground.position.set(this.#center.x, box.min.y, this.#center.z);
    this.#ground.scale.setScalar(this.#reach * 0.9);
    this.#ground.visible = true;
    this.#size();
    const far = this.#reach * 5.4 / Math.min(1, this.#camera.aspect);
    this.#camera.position.copy(this.#center).add(new Vector3(Math.sin(kTurned) * far, this.#reach * 0.5, Math.cos(kTurned) * far));
    this.#camera.lookAt(this.#center);
    this.#controls?.target.copy(this.#center);
  }

  clear() {
    if (this.#model) {
      this.#scene.remove(this.#model);
      free(this.#model);
    }
    this.#model = this.#mixer = this.#action = undefined;
    this.clips = [];
    this.#ground.visible = false;
    this.redraw();
  }

  turn(by) {
    const from = this.#camera.position.clone().sub(this.#center);
    from.applyAxisAngle(new Vector3(0, 1, 0), by);
    this.#camera.position.copy(this.#center).add(from);
  }

  // '' is the rest pose.
  play(name) {
    this.#mixer?.stopAllAction();
    const clip = this.clips.find((one) => one.name === name);
    this.#action = clip ? this.#mixer.clipAction(clip).play() : undefined;
    this.#mixer?.update(0);
    this.redraw();
  }
}

// What the graphics card holds of it: it comes there again if it is drawn again.
function free(root) {
  root.traverse((part) => {
    part.geometry?.dispose();
    part.material?.map?.dispose();
    part.material?.dispose();
    part.skeleton?.dispose();
  });
}
