// The picture: renderer, camera and light. It is drawn again only when something has changed.
import {
  AmbientLight,
  Box3,
  DirectionalLight,
  Group,
  PerspectiveCamera,
  Scene,
  Spherical,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const azimuth = -59; // degrees from x towards y, of the camera as seen from the middle
const elevation = 29; // degrees above the floor

/** Degrees; and how much nearer than where everything is just seen. */
export interface View {
  azimuth: number;
  elevation: number;
  zoom: number;
}

export class Stage {
  readonly scene = new Scene();
  /** What is in the world's frame, in m. The picture has its origin in the middle of the scene, for the sake of single precision. */
  readonly world = new Group();
  readonly camera = new PerspectiveCamera(32, 1, 0.1, 10);
  readonly renderer: WebGLRenderer;
  readonly controls: OrbitControls;
  onDraw: () => void = () => {};
  /** Whether a pixel has the colour of one thing, not a mean of several. */
  isPlain = false;
  private wanted = true;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly extent: Box3,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: false, alpha: true, powerPreference: "high-performance" });
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.redraw());
    extent.getCenter(this.middle);
    this.world.position.copy(this.middle).negate();
    const light = new DirectionalLight(0xffffff, 2.2);
    light.position.set(-0.6, 1, 0.9); // beside and above the viewer
    this.camera.add(light);
    this.scene.add(new AmbientLight(0xffffff, 1.1), this.camera, this.world);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
    this.show();
  }

  readonly middle = new Vector3();

  redraw(): void {
    this.wanted = true;
  }

  get isStale(): boolean {
    return this.wanted;
  }

  /** Pixels of the picture for one of the screen, along x and y; no more than anybody sees. */
  setRatio(ratio: number): void {
    const most = Math.max(2, devicePixelRatio);
    this.renderer.setPixelRatio(this.isPlain ? 1 : Math.min(ratio * devicePixelRatio, most));
    this.redraw();
  }

  /** Draws if anything has changed. */
  draw(): void {
    if (!this.wanted) return;
    this.wanted = false;
    this.renderer.render(this.scene, this.camera);
    this.onDraw();
  }

  /** Looks at the middle of `extent` (m; by default of the whole scene), which just fits into the picture. */
  show(extent = this.extent, view: View = { azimuth, elevation, zoom: 1 }): void {
    const size = this.extent.getSize(new Vector3()).length();
    const target = extent.getCenter(new Vector3()).sub(this.middle);
    const radians = Math.PI / 180;
    const back = new Vector3().setFromSpherical(new Spherical(1, Math.PI / 2 - view.elevation * radians, view.azimuth * radians));
    back.set(back.z, back.x, back.y); // three.js counts from its y upwards
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(back);
    this.camera.lookAt(target);
    this.camera.updateMatrixWorld();
    const distance = this.distanceToFit(extent, back);
    this.camera.position.copy(target).addScaledVector(back, distance / view.zoom);
    this.camera.near = size / 500;
    this.camera.far = distance / Math.min(view.zoom, 1) + 20 * size;
    this.controls.minDistance = size / 100;
    this.controls.maxDistance = 10 * size;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.redraw();
  }

  /** The least distance along `back` from the middle of the extent from which all its corners are in the picture. */
  private distanceToFit(extent: Box3, back: Vector3): number {
    const middle = extent.getCenter(new Vector3());
    const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    const high = Math.tan((this.camera.fov * Math.PI) / 360) * 0.94; // a margin
    const wide = high * this.camera.aspect;
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const [x, y, z] = [0, 1, 2].map((axis) => (corner >> axis) & 1);
      const { min, max } = extent;
      const point = new Vector3(x ? max.x : min.x, y ? max.y : min.y, z ? max.z : min.z).sub(middle);
      const towards = point.dot(back);
      distance = Math.max(distance, towards + Math.abs(point.dot(right)) / wide, towards + Math.abs(point.dot(up)) / high);
    }
    return distance;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.redraw();
    this.draw();
  }

  /** Where a point of the world (m) is in the canvas: x, y in CSS pixels. */
  project(point: Vector3): [number, number] {
    const { x, y } = point.clone().sub(this.middle).project(this.camera);
    return [((x + 1) / 2) * this.canvas.clientWidth, ((1 - y) / 2) * this.canvas.clientHeight];
  }

  /** m, of a CSS pixel at the middle of the scene. */
  metresPerPixel(): number {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.canvas.clientHeight;
  }
}
