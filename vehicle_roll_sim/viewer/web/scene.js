/** The picture: renderer, light, cameras and the vehicles of all runs. */

/** Position and target of a camera from the vehicle's place on the ground, along its heading (m). */
const CAMERAS = {
  chase: { from: [-7.2, -2.6, 2.7], to: [0.6, 0, 0.7], up: [0, 0, 1] },
  rear: { from: [-6.8, 0, 1.15], to: [0, 0, 0.75], up: [0, 0, 1] },
  top: { from: [0, 0, 16], to: [0, 0, 0], up: [1, 0, 0] },
};
const X = new THREE.Vector3(1, 0, 0), Z = new THREE.Vector3(0, 0, 1);
/** s: over these times about that shown the height of the ground is averaged for the camera. */
const STEADYING = [-0.4, -0.2, 0, 0.2, 0.4];

/** Height of the road below a vehicle (m), without its bumps. */
function groundLevel(recording, time) {
  const heights = STEADYING.map((each) => recording.at("ground", time + each)).filter(Number.isFinite);
  return heights.reduce((sum, each) => sum + each, 0) / Math.max(heights.length, 1);
}

class Picture {
  /** Raises an error where there is no WebGL. */
  constructor(canvas, recordings, cones, roads) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.scene = new THREE.Scene();
    this.scene.fog = new THREE.Fog(0, 40, 160);
    this.camera = new THREE.PerspectiveCamera(42, 1, 0.1, 400);
    this.ground = new Ground(this.scene);
    this.surface = new RoadSurface(this.scene);
    this.roads = roads;
    if (cones.length) conesAt(cones, this.scene);
    this.addLight();
    this.recordings = recordings;
    this.paths = recordings.map((each) => new Path(each, this.scene));
    this.camera.up.copy(Z);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 0.495 * Math.PI;
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("start", () => this.free());
    this.onFree = () => {};
    this.time = 0;
    this.choose(0);
    this.use("chase");
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  addLight() {
    this.sky = new THREE.HemisphereLight(0xffffff, 0xb4b9c0, 2.4);
    this.sun = new THREE.DirectionalLight(0xffffff, 1.5);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    const camera = this.sun.shadow.camera;
    Object.assign(camera, { left: -6, right: 6, top: 6, bottom: -6, near: 1, far: 40 });
    this.sun.shadow.bias = -0.002;
    this.scene.add(this.sky, this.sun, this.sun.target);
  }

  /** Build the vehicles: that of the followed run solid, the others as ghosts. */
  choose(index) {
    this.followed = index;
    for (const each of this.vehicles || []) each.leave(this.scene);
    this.vehicles = this.recordings.map((each, k) => new VehicleModel(each, k !== index));
    this.vehicles.forEach((each) => this.scene.add(each.group));
    this.layRoad();
  }

  /** Show the road of the followed run. */
  layRoad() {
    const road = this.roads[this.recordings[this.followed].road] || null;
    if (road !== this.road) this.surface.hold(road);
    this.road = road;
    this.ground.appear(!road);
    this.paint();
  }

  get vehicle() {
    return this.vehicles[this.followed];
  }

  /** Draw the paths that the runs have by now, and the road if it is another. */
  renew(road) {
    for (const path of this.paths) path.renew();
    if (road === undefined) return;
    this.roads = [road];
    this.layRoad();
  }

  /** Take the colours of the page's theme. */
  paint() {
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(name).trim();
    this.scene.background = new THREE.Color(colour("--sky"));
    this.scene.fog.color.set(colour("--sky"));
    this.ground.paint(colour);
    this.surface.paint(colour);
    surfaceLegend($("surfaces"), this.surface.kinds(colour));
    this.paths.forEach((path, k) => path.paint(colour(`--run-${k}`)));
    this.vehicles.forEach((each, k) => each.paint(colour(`--run-${k}`), colour("--glass")));
    this.draw();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.fov = clientWidth < clientHeight ? 56 : 42;
    this.camera.updateProjectionMatrix();
    this.render(); // at once: the canvas is empty after a change of its size
  }

  /** Choose a camera by name. */
  use(name) {
    if (name === "free") this.free();
    else this.view = name;
    this.show(this.time);
  }

  /** Leave the camera where it is, upright, for the pointer to move it. */
  free() {
    if (this.view === "top") {
      const heading = new THREE.Vector3(1, 0, 0).applyAxisAngle(Z, this.vehicle.chassis.rotation.z);
      this.camera.position.addScaledVector(heading, -0.1);
    }
    this.view = "free";
    this.camera.up.copy(Z);
    this.onFree();
  }

  show(time) {
    this.time = time;
    for (const vehicle of this.vehicles) vehicle.pose(time);
    for (const path of this.paths) path.show(time);
    const { chassis, group } = this.vehicle;
    const { recording } = this.vehicle, tilt = recording.at("tilt", time) || 0;
    if (group.visible) this.look(chassis.position, groundLevel(recording, time), chassis.rotation.z, tilt);
    this.draw();
  }

  /** Move ground, sun and camera with the vehicle. A table tilts by turning the camera the other way. */
  look({ x, y }, z, yaw, tilt) {
    this.ground.follow(x, y);
    this.sun.position.set(x - 6, y + 8, z + 16);
    this.sun.target.position.set(x, y, z);
    this.sun.target.updateMatrixWorld();
    const here = new THREE.Vector3(x, y, z), camera = CAMERAS[this.view];
    if (camera) {
      const along = (place) => new THREE.Vector3(...place).applyAxisAngle(Z, yaw).applyAxisAngle(X, -tilt);
      const turned = (place) => along(place).add(here);
      this.camera.up.copy(along(camera.up));
      this.camera.position.copy(turned(camera.from));
      this.controls.target.copy(turned(camera.to));
    } else {
      this.camera.up.copy(Z);
      const way = here.clone().sub(this.here);
      this.camera.position.add(way);
      this.controls.target.add(way);
    }
    this.here = here;
    this.camera.lookAt(this.controls.target);
  }

  /** Draw in the next frame, however often this is asked for. */
  draw() {
    if (!this.isWaiting) requestAnimationFrame(() => this.render());
    this.isWaiting = true;
  }

  render() {
    this.isWaiting = false;
    this.renderer.render(this.scene, this.camera);
  }
}
