/** Ground with a grid that follows the vehicle, the path of each run, and cones. */

/** m: width of a path. */
const PATH_WIDTH = 0.1;
/** m: height of a path over a road that is not a plane, so that it is not hidden by its edges. */
const ABOVE_ROAD = 0.02;
/** m: spacing of the fine and the coarse grid, extent of each, and width of its lines. */
const FINE = { mesh: 1, size: 80, width: 0.015 }, COARSE = { mesh: 10, size: 400, width: 0.05 };
const CONE = { height: 0.5, radius: 0.13 };

class Ground {
  constructor(scene) {
    const material = new THREE.MeshLambertMaterial({ depthWrite: false });
    this.plane = new THREE.Mesh(new THREE.PlaneGeometry(1200, 1200), material);
    this.plane.receiveShadow = true;
    this.plane.renderOrder = -3;
    this.fine = this.grid(FINE);
    this.coarse = this.grid(COARSE);
    scene.add(this.plane, this.fine, this.coarse);
  }

  /** Lines as narrow bands: near the camera, lines of one pixel would be too thin to see. */
  grid({ mesh, size, width }) {
    const at = [], faces = [], end = size / 2, half = width / 2;
    const band = (left, right, near, far) => {
      const k = at.length / 3;
      at.push(left, near, 0, right, near, 0, right, far, 0, left, far, 0);
      faces.push(k, k + 1, k + 2, k, k + 2, k + 3);
    };
    for (let place = -end; place <= end; place += mesh) {
      band(place - half, place + half, -end, end);
      band(-end, end, place - half, place + half);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(at, 3));
    geometry.setIndex(faces);
    const settings = { depthTest: false, depthWrite: false, side: THREE.DoubleSide };
    const lines = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial(settings));
    lines.renderOrder = mesh > FINE.mesh ? -1 : -2;
    return lines;
  }

  paint(colour) {
    this.plane.material.color.set(colour("--ground"));
    this.fine.material.color.set(colour("--minor"));
    this.coarse.material.color.set(colour("--major"));
  }

  /** Show the plane, or leave the place to the surface of a road. */
  appear(isPlane) {
    for (const each of [this.plane, this.fine, this.coarse]) each.visible = isPlane;
  }

  follow(x, y) {
    for (const each of [this.plane, this.fine, this.coarse]) {
      each.position.x = Math.round(x / COARSE.mesh) * COARSE.mesh;
      each.position.y = Math.round(y / COARSE.mesh) * COARSE.mesh;
    }
  }
}

/** The path of the sprung c.g. on the ground: faint as a whole, strong up to the time shown. */
class Path {
  constructor(recording, scene) {
    this.recording = recording;
    const geometry = this.ribbon(recording);
    const of = (opacity) => new THREE.Mesh(geometry.clone(), new THREE.MeshBasicMaterial({
      transparent: true, opacity, side: THREE.DoubleSide, depthWrite: false,
    }));
    this.whole = of(0.25);
    this.done = of(0.8);
    geometry.dispose();
    for (const each of [this.whole, this.done]) {
      each.frustumCulled = false;
      each.position.z = 0.002 * (recording.index + 1);
      scene.add(each);
    }
  }

  /** A band along the path: two points and two faces for each sample, none where the position is unknown. */
  ribbon({ time, columns }) {
    const { x, y, ground } = columns, at = [], faces = [], last = time.length - 1;
    let wasKnown = false;
    for (let k = 0; k <= last; k++) {
      const before = Math.max(k - 1, 0), after = Math.min(k + 1, last);
      const dx = x[after] - x[before], dy = y[after] - y[before];
      const isKnown = Number.isFinite(x[k] + y[k] + dx + dy);
      const half = isKnown ? PATH_WIDTH / 2 / (Math.hypot(dx, dy) || 1) : 0;
      for (const side of [half, -half]) {
        const height = ground ? ground[k] + ABOVE_ROAD : 0;
        at.push(...(isKnown ? [x[k] - side * dy, y[k] + side * dx, height] : [0, 0, 0]));
      }
      const p = wasKnown && isKnown ? 2 * k - 2 : -1;
      if (k) faces.push(...(p < 0 ? [0, 0, 0, 0, 0, 0] : [p, p + 1, p + 2, p + 2, p + 1, p + 3]));
      wasKnown = isKnown;
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(at, 3));
    geometry.setIndex(faces);
    return geometry;
  }

  /** Follow the present samples of the run. */
  renew() {
    const geometry = this.ribbon(this.recording);
    for (const each of [this.whole, this.done]) {
      each.geometry.dispose();
      each.geometry = geometry.clone();
    }
    geometry.dispose();
  }

  paint(colour) {
    for (const each of [this.whole, this.done]) each.material.color.set(colour);
  }

  show(time) {
    this.done.geometry.setDrawRange(0, 6 * this.recording.place(time)[0]);
  }
}

/** Traffic cones at points (m) on the ground. */
function conesAt(points, scene) {
  const cone = new THREE.ConeGeometry(CONE.radius, CONE.height, 20).rotateX(Math.PI / 2);
  const band = new THREE.CylinderGeometry(0.42 * CONE.radius, 0.62 * CONE.radius, 0.2 * CONE.height, 20);
  const foot = new THREE.BoxGeometry(2.3 * CONE.radius, 2.3 * CONE.radius, 0.03);
  const parts = [
    [cone, 0xf36a10, CONE.height / 2],
    [band.rotateX(Math.PI / 2), 0xf7f7f7, 0.5 * CONE.height],
    [foot, 0xf36a10, 0.015],
  ];
  for (const [geometry, color, height] of parts) {
    const mesh = new THREE.InstancedMesh(geometry, new THREE.MeshLambertMaterial({ color }), points.length);
    const place = new THREE.Matrix4();
    points.forEach(([x, y], k) => mesh.setMatrixAt(k, place.makeTranslation(x, y, height)));
    mesh.castShadow = true;
    mesh.frustumCulled = false;
    scene.add(mesh);
  }
}
