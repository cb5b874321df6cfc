// The model in 3D: turning, and playing its clips.
import {
  AmbientLight, AnimationMixer, Box3, CircleGeometry, Color, DirectionalLight, Mesh, MeshBasicMaterial, PerspectiveCamera, Scene,
  Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { addInkHull } from './ink_hull.js';

const kFrameTime_ms = 1000 / 60;

export class ModelStage extends EventTarget {
  // Throws where there is no WebGL.
  constructor(canvas) {
    super();
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(30, 1, 0.01, 100);
    const sun = new DirectionalLight(0xffffff, 1.1);
    sun.position.set(1, 2, 3);
    this.scene.add(new AmbientLight(0xffffff, 2.3), sun);
    this.ground = new Mesh(new CircleGeometry(1, 64).rotateX(-Math.PI / 2),
      new MeshBasicMaterial({ color: 0x7d8fb3, transparent: true, opacity: 0.18, depthWrite: false }));
    this.scene.add(this.ground);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = false;
    this.controls.enableDamping = true;
    this.playing = true;
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
    let last = performance.now();
    this.renderer.setAnimationLoop((now) => {
      if (this.busy) return;
      this.step(Math.min(0.1, (now - last) / 1000));
      last = now;
    });
  }

  #resize() {
    if (this.busy) return;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  step(time_s) {
    if (this.playing) {
      this.mixer?.update(time_s);
      this.flat?.show(this.action?.time ?? 0);
    }
    this.controls.update();
    this.renderer.render(this.scene, this.camera);
  }

  // Goes on with the same clip at the same time, seen from the same side, if `keep`.
  async show(glb, keep) {
    const { scene, animations } = await new GLTFLoader().parseAsync(glb.buffer, '');
    const time = this.action?.time ?? 0;
    if (this.model) {
      this.scene.remove(this.model);
      this.model.traverse((part) => {
        part.geometry?.dispose();
        part.material?.map?.dispose();
        part.material?.dispose();
      });
    }
    this.model = scene;
    scene.visible = !this.flat;
    this.clips = animations;
    addInkHull(scene);
    scene.traverse((part) => { part.frustumCulled = false; });
    this.scene.add(scene);
    this.mixer = new AnimationMixer(scene);
    this.action = null;
    if (!keep) this.#frame();
    this.play(this.clip ?? '', time);
  }

  // The drawing itself in place of the model, from the front; null: the model again.
  showFlat(figure) {
    if (this.flat) {
      this.scene.remove(this.flat.mesh);
      this.flat.dispose();
    }
    const turned = !this.flat !== !figure;
    this.flat = figure;
    this.model.visible = this.ground.visible = this.controls.enableRotate = !figure;
    if (figure) {
      this.scene.add(figure.mesh);
      figure.show(this.action?.time ?? 0);
    }
    if (turned) this.face(figure ? 0 : 0.35);
  }

  #frame() {
    const box = new Box3().setFromObject(this.model);
    const size = box.getSize(new Vector3());
    this.center = box.getCenter(new Vector3());
    this.reach = Math.max(size.x, size.y) * 0.5;
    this.ground.position.set(this.center.x, box.min.y, this.center.z);
    this.ground.scale.setScalar(this.reach * 0.9);
    this.face(this.flat ? 0 : 0.35);
  }

  // Looks at the model from this angle about the vertical, rad.
  face(angle) {
    const far = this.reach * 5.4 / Math.min(1, this.camera.aspect);
    this.camera.position.copy(this.center).add(new Vector3(Math.sin(angle) * far, this.reach * 0.5, Math.cos(angle) * far));
    this.controls.target.copy(this.center);
    this.controls.update();
  }
  turn(by) {
    const from = this.camera.position.clone().sub(this.center);
    from.applyAxisAngle(new Vector3(0, 1, 0), by);
    this.camera.position.copy(this.center).add(from);
  }

  // '' is the rest pose.
  play(name, time = 0) {
    this.clip = name;
    this.mixer?.stopAllAction();
    const clip = this.clips?.find((one) => one.name === name);
    this.action = clip ? this.mixer.clipAction(clip).play() : null;
    if (this.action) this.action.time = time % clip.duration;
    this.mixer?.update(0);
  }
  get duration() { return this.action?.getClip().duration ?? 1; }

  // `count` pictures of one round of the clip, size×size px, transparent, as canvases handed to `take` one by one.
  async pictures(count, size, take) {
    this.busy = true;
    const { ground, renderer, camera } = this;
    const time = this.action?.time ?? 0;
    try {
      ground.visible = false;
      renderer.setPixelRatio(1);
      renderer.setSize(size, size, false);
      camera.aspect = 1;
      camera.updateProjectionMatrix();
      for (let i = 0; i < count; ++i) {
        this.mixer.setTime(0);
        if (this.action) this.action.time = this.duration * i / count;
        this.mixer.update(0);
        this.flat?.show(this.action?.time ?? 0);
        renderer.render(this.scene, camera);
        await take(this.canvas, i);
      }
    } finally {
      if (this.action) this.action.time = time;
      ground.visible = !this.flat;
      this.busy = false;
      this.#resize();
    }
  }

  // One round of the clip, at least 2 s, as {blob, ending}; null where the browser records nothing.
  async film() {
    const kinds = [['video/mp4;codecs=avc1.42E01E', 'mp4'], ['video/webm;codecs=vp9', 'webm'], ['video/webm', 'webm'], ['video/mp4', 'mp4']];
    const kind = globalThis.MediaRecorder && this.canvas.captureStream && kinds.find(([type]) => MediaRecorder.isTypeSupported(type));
    if (!kind) return null;
    const length_s = Math.max(1, Math.ceil(2 / this.duration)) * this.duration;
    this.scene.background = new Color(0xffffff); // films have no transparency
    const recorder = new MediaRecorder(this.canvas.captureStream(30), { mimeType: kind[0], videoBitsPerSecond: 6e6 });
    const parts = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    const stopped = new Promise((resolve) => { recorder.onstop = resolve; });
    const { playing } = this;
    this.playing = true;
    this.play(this.clip);
    recorder.start();
    await new Promise((resolve) => setTimeout(resolve, length_s * 1000 + kFrameTime_ms));
    recorder.stop();
    await stopped;
    this.playing = playing;
    this.scene.background = null;
    return { blob: new Blob(parts, { type: kind[0].split(';')[0] }), ending: kind[1] };
  }
}
