// The match in space: the same moments as from above, seen from the stand or from anywhere.

import {
  AmbientLight, BoxGeometry, BufferGeometry, CanvasTexture, CapsuleGeometry, CircleGeometry, Color, ConeGeometry,
  CylinderGeometry, DirectionalLight, Fog, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial,
  MeshLambertMaterial, Object3D, PerspectiveCamera, Plane, PlaneGeometry, Raycaster, RingGeometry, Scene as Space,
  SphereGeometry, Sprite, SpriteMaterial, SRGBColorSpace, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Id, Measures, Player, Scene } from "./messages";
import { field } from "./pitch";
import type { Frame, Painted, View } from "./view";
import { USUAL, extent, grounds, mixed, same, shirt, towards } from "./view";

/** Pixels of the ground's picture along the usual pitch. */
const GROUND_PX = 1888;
/** Metres per stride, both legs. */
const STRIDE_M = 1.9;
const SKIN = "#c98f68";
/** How fast the camera follows, shares of the way per second. */
const FOLLOWS = 3;

export type Camera = "stand" | "free";

interface Figure {
  group: Group;
  body: Group;
  legs: [Mesh, Mesh];
  ring: Mesh;
  shadow: Mesh;
  /** How far they have run, metres. */
  run: number;
  at: [number, number];
  look: string;
}

export class Stadium implements View {
  private readonly renderer: WebGLRenderer;
  private readonly space = new Space();
  private readonly camera = new PerspectiveCamera(30, 1.6, 0.5, 400);
  private readonly controls: OrbitControls;
  private readonly figures = new Map<string, Figure>();
  private readonly ball: Mesh;
  private readonly shadow: Mesh;
  private readonly line: Mesh;
  private readonly regions: Mesh;
  private readonly arrows = new Group();
  /** What is built for this pitch: the ground, the goals and the stands. */
  private readonly built = new Group();
  private pitch: Measures | null = null;
  private painted: Painted | null = null;
  private drawn = performance.now();
  private readonly aim = new Vector3();
  private from: Camera = "stand";
  private isAimed = false;
  /** The player that the camera follows; null: the ball. */
  followed: Id | null = null;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.outputColorSpace = SRGBColorSpace;
    const sky = new Color("#9fc3da");
    this.space.background = sky;
    this.space.fog = new Fog(sky, 150, 330);
    this.space.add(new AmbientLight("#ffffff", 1.7));
    const sun = new DirectionalLight("#fff4dc", 1.9);
    sun.position.set(-40, 70, 30);
    this.space.add(sun);
    this.ball = new Mesh(new SphereGeometry(0.2, 20, 14), new MeshLambertMaterial({ color: "#ffffff" }));
    this.shadow = blob(0.25);
    this.line = new Mesh(
      new PlaneGeometry(0.25, 1),
      new MeshBasicMaterial({ color: "#ff8278", transparent: true, opacity: 0.8 }),
    );
    this.line.rotation.x = -Math.PI / 2;
    this.line.position.y = 0.03;
    this.regions = flat(1, 1, new MeshBasicMaterial({ transparent: true }));
    this.regions.position.y = 0.015;
    this.regions.visible = false;
    this.space.add(this.built, this.ball, this.shadow, this.line, this.regions, this.arrows);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 1.52;
    this.controls.minDistance = 4;
    this.controls.maxDistance = 160;
    this.controls.enabled = false;
  }

  /** Chooses where it is seen from. */
  see(from: Camera): void {
    this.from = from;
    this.controls.enabled = from === "free";
    if (from === "free") this.controls.target.copy(this.aim);
  }

  place(x: number, y: number): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const hit = ray.ray.intersectPlane(new Plane(new Vector3(0, 1, 0), 0), new Vector3());
    // Above the horizon there is no grass.
    return hit ? [hit.x, hit.z] : [Infinity, Infinity];
  }

  draw(frame: Frame): void {
    const scene = frame.scenes[frame.at];
    const now = performance.now();
    const seconds = Math.min(0.2, (now - this.drawn) / 1000);
    this.drawn = now;
    this.fit();
    if (scene) this.stage(frame, scene, seconds);
    this.renderer.render(this.space, this.camera);
  }

  private stage(frame: Frame, scene: Scene, seconds: number): void {
    this.build(scene.pitch);
    const to = towards(frame) ?? scene;
    const shown = new Set<string>();
    for (const player of scene.players) {
      if (!player.present) continue;
      const key = `${player.id.team}${player.id.slot}`;
      shown.add(key);
      const then = to.players.find((it) => same(it.id, player.id)) ?? player;
      const has = same(scene.ball.owner, player.id);
      this.move(this.figure(key, player), player, mixed(player.pos, then.pos, frame.share), has);
    }
    for (const [key, figure] of this.figures) figure.group.visible = shown.has(key);
    const [ball, end] = [scene.ball.pos, to.ball.pos];
    const [x, y] = mixed([ball[0], ball[1]], [end[0], end[1]], frame.share);
    const high = Math.max(0.2, ball[2] + (end[2] - ball[2]) * frame.share);
    this.ball.rotation.z -= (x - this.ball.position.x) / 0.2;
    this.ball.rotation.x += (y - this.ball.position.z) / 0.2;
    this.ball.position.set(x, high, y);
    this.shadow.position.set(x, 0.02, y);
    this.line.visible = frame.offside !== null;
    this.line.position.x = frame.offside ?? 0;
    this.lay(frame.regions);
    this.point(frame);
    this.follow(scene, new Vector3(x, Math.min(high, 4) * 0.5, y), seconds);
  }

  /** Builds what stands around a match, unless it stands there already. */
  private build(pitch: Measures): void {
    const known = this.pitch;
    this.pitch = pitch;
    if (known && alike(known, pitch)) return;
    this.built.traverse(dispose);
    this.built.clear();
    this.built.add(...ground(pitch), ...goals(pitch), ...stands(pitch));
    this.line.scale.y = pitch.width_m;
  }

  private follow(scene: Scene, ball: Vector3, seconds: number): void {
    const who = scene.players.find((player) => same(player.id, this.followed));
    const goal = who ? new Vector3(who.pos[0], 1, who.pos[1]) : ball;
    if (!this.isAimed) {
      this.isAimed = true;
      this.aim.copy(goal);
      this.controls.target.copy(goal);
      this.stand(goal, scene.pitch);
    }
    const before = this.aim.clone();
    this.aim.lerp(goal, Math.min(1, FOLLOWS * seconds));
    if (this.from === "stand") {
      this.stand(this.aim, scene.pitch);
    } else {
      const moved = this.aim.clone().sub(before);
      this.camera.position.add(moved);
      this.controls.target.add(moved);
      this.controls.update();
    }
  }

  private stand(aim: Vector3, { width_m }: Measures): void {
    this.camera.position.set(aim.x * 0.75, 21, width_m / 2 + 24);
    this.camera.lookAt(aim.x * 0.95, 0, aim.z * 0.55 + 4);
  }

  /** Fits the picture to the page. */
  private fit(): void {
    const width = this.canvas.clientWidth;
    const height = Math.round((width * USUAL.y) / USUAL.x);
    const size = this.renderer.getSize(new Vector2());
    if (width === 0 || (size.x === width && size.y === height)) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
    this.canvas.style.height = `${height}px`;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  private lay(painted: Painted | null): void {
    if (painted === this.painted) return;
    this.painted = painted;
    const material = this.regions.material as MeshBasicMaterial;
    material.map?.dispose();
    material.map = painted ? new CanvasTexture(painted.picture) : null;
    if (material.map) material.map.colorSpace = SRGBColorSpace;
    material.needsUpdate = true;
    if (painted) this.regions.scale.set(2 * painted.half[0], 2 * painted.half[1], 1);
    this.regions.visible = painted !== null;
  }

  private point(frame: Frame): void {
    for (const old of this.arrows.children) {
      (old as Line).geometry.dispose();
      ((old as Line).material as LineBasicMaterial).dispose();
    }
    this.arrows.clear();
    for (const { from, to, fade, shot } of frame.arrows) {
      const ends = [new Vector3(from[0], 0.06, from[1]), new Vector3(to[0], 0.06, to[1])] as const;
      const colour = { color: shot ? "#ff8278" : "#ffffff", transparent: true, opacity: fade };
      this.arrows.add(new Line(new BufferGeometry().setFromPoints([...ends]), new LineBasicMaterial(colour)));
      const tip = new Mesh(new ConeGeometry(0.4, 1.2, 10), new MeshBasicMaterial(colour));
      const way = ends[1].clone().sub(ends[0]);
      if (way.length() < 2) continue;
      tip.position.copy(ends[1]).addScaledVector(way.normalize(), -0.8);
      tip.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), way);
      this.arrows.add(tip);
    }
  }

  private figure(key: string, player: Player): Figure {
    const [cloth, ink] = shirt(player);
    const look = `${cloth}${player.number}`;
    const known = this.figures.get(key);
    if (known?.look === look) return known;
    if (known) this.space.remove(known.group);
    const made = figure(cloth, ink, player.number, look);
    this.figures.set(key, made);
    this.space.add(made.group);
    return made;
  }

  private move(figure: Figure, player: Player, at: [number, number], has: boolean): void {
    const moved = Math.hypot(at[0] - figure.at[0], at[1] - figure.at[1]);
    // Who was placed elsewhere has not run there.
    figure.run += moved < 3 ? moved : 0;
    figure.at = at;
    figure.group.position.set(at[0], 0, at[1]);
    figure.group.rotation.y = -Math.atan2(player.facing[1], player.facing[0]);
    const speed = Math.hypot(player.vel[0], player.vel[1]);
    const swing = Math.min(1, speed / 6) * Math.sin((2 * Math.PI * figure.run) / STRIDE_M);
    figure.legs[0].rotation.z = swing;
    figure.legs[1].rotation.z = -swing;
    const lies = { fallen: 1.45, sliding: 1.1, diving: 1.35 }[player.posture] ?? 0;
    const ahead = player.posture === "sliding" ? lies : -lies;
    figure.body.rotation.z = lies ? ahead : -Math.min(0.25, speed * 0.028);
    figure.body.position.y = lies ? 0.25 : 0;
    figure.ring.visible = player.agent || has;
    (figure.ring.material as MeshBasicMaterial).opacity = player.agent ? 0.95 : 0.4;
  }
}

function alike(a: Measures, b: Measures): boolean {
  return a === b || Object.values(a).join() === Object.values(b).join();
}

/** Frees what the graphics card keeps of an object. */
function dispose(object: Object3D): void {
  if (!(object instanceof Mesh || object instanceof Line)) return;
  object.geometry.dispose();
  object.material.map?.dispose();
  object.material.dispose();
}

function lambert(color: string): MeshLambertMaterial {
  return new MeshLambertMaterial({ color });
}

function flat(width: number, depth: number, material: MeshBasicMaterial | MeshLambertMaterial): Mesh {
  const mesh = new Mesh(new PlaneGeometry(width, depth), material);
  mesh.rotation.x = -Math.PI / 2;
  return mesh;
}

function blob(radius: number): Mesh {
  const dark = new MeshBasicMaterial({ color: "#06140a", transparent: true, opacity: 0.4, depthWrite: false });
  const mesh = new Mesh(new CircleGeometry(radius, 20), dark);
  mesh.rotation.x = -Math.PI / 2;
  mesh.position.y = 0.02;
  return mesh;
}

/** The grass with its lines, and what is around it. */
function ground(pitch: Measures): Mesh[] {
  const canvas = document.createElement("canvas");
  const [x, y] = grounds(pitch);
  const scale = GROUND_PX / (2 * extent(pitch)[0]);
  [canvas.width, canvas.height] = [Math.round(2 * x * scale), Math.round(2 * y * scale)];
  const context = canvas.getContext("2d");
  if (!context) throw new Error("no canvas");
  context.setTransform(scale, 0, 0, scale, canvas.width / 2, canvas.height / 2);
  field(context, pitch, { grass: "#2f7a40", stripe: "#38884a", line: "#f2f7f2" });
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  map.anisotropy = 8;
  const around = flat(400, 400, lambert("#2a5f38"));
  around.position.y = -0.05;
  return [flat(2 * x, 2 * y, new MeshLambertMaterial({ map })), around];
}

function goals(pitch: Measures): Group[] {
  const [half, high] = [pitch.goal_width_m / 2, pitch.goal_height_m];
  return [-1, 1].map((side) => {
    const group = new Group();
    const white = lambert("#ffffff");
    const bar = (length: number): Mesh => new Mesh(new CylinderGeometry(0.07, 0.07, length, 10), white);
    for (const post of [-half, half]) {
      const upright = bar(high);
      upright.position.set(0, high / 2, post);
      group.add(upright);
    }
    const cross = bar(2 * half);
    cross.rotation.x = Math.PI / 2;
    cross.position.y = high;
    group.add(cross, net(pitch));
    group.position.x = (side * pitch.length_m) / 2;
    group.rotation.y = side > 0 ? 0 : Math.PI;
    return group;
  });
}

/** The net behind the line, as threads. */
function net(pitch: Measures): Group {
  const group = new Group();
  const thread = new LineBasicMaterial({ color: "#e8eef0", transparent: true, opacity: 0.55 });
  const add = (...points: [number, number, number][]): void => {
    const places = points.map(([x, y, z]) => new Vector3(x, y, z));
    group.add(new Line(new BufferGeometry().setFromPoints(places), thread));
  };
  const [half, high, deep] = [pitch.goal_width_m / 2, pitch.goal_height_m, pitch.goal_depth_m];
  const top = deep * 0.4;
  for (let z = -half; z <= half + 0.01; z += (2 * half) / 16) add([0, high, z], [top, high, z], [deep, 0, z]);
  for (let k = 0; k <= 8; k++) {
    const [x, y] = [top + ((deep - top) * k) / 8, high * (1 - k / 8)];
    add([0, y, -half], [x, y, -half], [x, y, half], [0, y, half]);
  }
  return group;
}

function stands(pitch: Measures): Mesh[] {
  const seats = lambert("#5a6675");
  const boards = lambert("#20303f");
  const made: Mesh[] = [];
  const box = (x: number, y: number, z: number, [w, h, d]: [number, number, number], of: MeshLambertMaterial): void => {
    const mesh = new Mesh(new BoxGeometry(w, h, d), of);
    mesh.position.set(x, y, z);
    made.push(mesh);
  };
  const [x, z] = grounds(pitch);
  box(0, 0.45, -z, [2 * x, 0.9, 0.2], boards);
  for (const side of [-1, 1]) box(side * x, 0.45, 0, [0.2, 0.9, 2 * z], boards);
  for (let row = 0; row < 8; row++) {
    const [far, high] = [4 + 2 * row, 1 + 1.1 * row];
    box(0, high, -z - far, [2 * x + 12, 1, 2], seats);
    for (const side of [-1, 1]) box(side * (x + far), high, 0, [2, 1, 2 * z], seats);
  }
  return made;
}

function figure(cloth: string, ink: string, number: number, look: string): Figure {
  const [group, body] = [new Group(), new Group()];
  const shorts = new Color(cloth).multiplyScalar(0.55);
  const torso = new Mesh(new CapsuleGeometry(0.24, 0.5, 4, 12), lambert(cloth));
  torso.position.y = 1.2;
  torso.scale.z = 1.25;
  const hips = new Mesh(new CapsuleGeometry(0.22, 0.12, 4, 10), new MeshLambertMaterial({ color: shorts }));
  hips.position.y = 0.88;
  const head = new Mesh(new SphereGeometry(0.16, 14, 10), lambert(SKIN));
  head.position.y = 1.74;
  const leg = (z: number): Mesh => {
    const mesh = new Mesh(new CapsuleGeometry(0.095, 0.66, 4, 8).translate(0, -0.42, 0), lambert(SKIN));
    mesh.position.set(0, 0.85, z);
    return mesh;
  };
  const legs: [Mesh, Mesh] = [leg(-0.14), leg(0.14)];
  for (const z of [-0.36, 0.36]) {
    const arm = new Mesh(new CapsuleGeometry(0.075, 0.5, 4, 8), lambert(cloth));
    arm.position.set(0, 1.2, z);
    arm.rotation.x = z > 0 ? -0.2 : 0.2;
    body.add(arm);
  }
  const ring = new Mesh(
    new RingGeometry(0.75, 0.95, 28),
    new MeshBasicMaterial({ color: "#ffffff", transparent: true, depthWrite: false }),
  );
  ring.rotation.x = -Math.PI / 2;
  ring.position.y = 0.025;
  const shadow = blob(0.5);
  body.add(torso, hips, head, ...legs);
  group.add(body, ring, shadow, tag(number, cloth, ink));
  return { group, body, legs, ring, shadow, run: 0, at: [0, 0], look };
}

/** The number above a player. */
function tag(number: number, cloth: string, ink: string): Sprite {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const c = canvas.getContext("2d");
  if (!c) throw new Error("no canvas");
  c.fillStyle = cloth;
  c.beginPath();
  c.arc(32, 32, 28, 0, 7);
  c.fill();
  c.fillStyle = ink;
  c.font = "700 34px system-ui, sans-serif";
  c.textAlign = "center";
  c.textBaseline = "middle";
  c.fillText(String(number), 32, 35);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(new SpriteMaterial({ map, depthWrite: false }));
  sprite.position.y = 2.35;
  sprite.scale.setScalar(0.8);
  return sprite;
}
