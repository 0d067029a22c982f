/** The drawn shape of a vehicle. Its proportions are for display only; its dimensions come from `told`. */

/** m: space between a tire and its wheel arch. */
const ARCH = 0.07;
/** Heights as fractions of that between underside and roof. */
const RISE = 0.13, BONNET = 0.5, WAIST = 0.56;
/** Width of the roof over that of the body. */
const TAPER = 0.82;
/** Distances of the ends of cabin and roof from tail and front axle, over the length of the body. */
const CABIN = { tail: 0.05, hatch: 0.12, scuttle: 0.07, screen: 0.25 };

function profile(points) {
  const shape = new THREE.Shape();
  points.forEach(([x, z], k) => (k ? shape.lineTo(x, z) : shape.moveTo(x, z)));
  return shape;
}

/** A profile in the x-z plane, drawn out along y to a width, with rounded edges. */
function drawnOut(shape, width, bevel) {
  const settings = { depth: width - 2 * bevel, bevelSize: bevel, bevelThickness: bevel };
  const geometry = new THREE.ExtrudeGeometry(shape, { ...settings, bevelSegments: 3, curveSegments: 20 });
  geometry.translate(0, 0, bevel - width / 2);
  return geometry.rotateX(Math.PI / 2);
}

/** Lower body with wheel arches. body: its extent about the c.g. (m); wheels: their places. */
function lowerBody(body, wheels) {
  const { ahead, behind, bottom, top, width } = body, height = top - bottom, bevel = 0.05;
  const bonnet = bottom + BONNET * height, waist = bottom + WAIST * height;
  const shape = new THREE.Shape();
  shape.moveTo(-behind + bevel, bottom + RISE * height);
  shape.lineTo(-behind + 0.45, bottom + bevel);
  for (const wheel of [wheels[2], wheels[0]]) {
    const radius = wheel.radius + ARCH, [x, , z] = wheel.place, rise = bottom + bevel - z;
    const half = Math.sqrt(Math.max(radius * radius - rise * rise, 0)) + bevel;
    const reach = Math.hypot(half, rise), from = Math.atan2(rise, -half);
    shape.lineTo(x - half, bottom + bevel);
    shape.absarc(x, z, reach, from, Math.atan2(rise, half), true);
  }
  shape.lineTo(ahead - 0.35, bottom + bevel);
  shape.lineTo(ahead - bevel, bottom + RISE * height);
  shape.lineTo(ahead - bevel, bottom + 0.34 * height);
  shape.lineTo(ahead - 0.16, bonnet - bevel);
  shape.lineTo(wheels[0].place[0] - 0.35 * wheels[0].radius, waist - bevel);
  shape.lineTo(-behind + 0.12, waist - bevel);
  shape.lineTo(-behind + bevel, bottom + 0.4 * height);
  return drawnOut(shape, width, bevel);
}

/** x of the rear and front ends of the roof (m). */
function roofEnds({ ahead, behind }, wheels) {
  const length = ahead + behind;
  return [CABIN.hatch * length - behind, wheels[0].place[0] - CABIN.screen * length];
}

/** The cabin, narrower towards the roof. */
function cabin(body, wheels) {
  const { ahead, behind, bottom, top, width } = body, length = ahead + behind;
  const base = bottom + WAIST * (top - bottom) - 0.06, [rear, front] = roofEnds(body, wheels);
  const shape = profile([
    [CABIN.tail * length - behind, base], [wheels[0].place[0] - CABIN.scuttle * length, base],
    [front, top], [rear, top],
  ]);
  const geometry = drawnOut(shape, width - 0.1, 0.001), at = geometry.attributes.position;
  for (let k = 0; k < at.count; k++) {
    const share = (at.getZ(k) - base) / (top - base);
    at.setY(k, at.getY(k) * (1 - share * (1 - TAPER)));
  }
  geometry.computeVertexNormals();
  return geometry;
}

/** Lights and bumpers. */
function details(body) {
  const { ahead, behind, bottom, top, width } = body, height = top - bottom, group = new THREE.Group();
  const dark = new THREE.MeshLambertMaterial({ color: 0x2b3036 });
  const add = (size, place, material) => {
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(...size), material);
    mesh.position.set(...place);
    group.add(mesh);
  };
  const white = new THREE.MeshBasicMaterial({ color: 0xfff6d8 });
  const red = new THREE.MeshBasicMaterial({ color: 0xd01818 });
  for (const x of [ahead - 0.04, -behind + 0.04]) {
    add([0.1, 0.94 * width, 0.13 * height], [x, 0, bottom + 0.22 * height], dark);
  }
  for (const side of [-1, 1]) {
    add([0.06, 0.3, 0.11], [ahead - 0.05, side * (0.5 * width - 0.26), bottom + 0.37 * height], white);
    add([0.06, 0.3, 0.11], [-behind + 0.05, side * (0.5 * width - 0.24), bottom + 0.43 * height], red);
  }
  return group;
}

/** The body of a vehicle about its c.g.; opacity below 1 for a ghost. */
function bodyOf(told, opacity) {
  const seen = { transparent: opacity < 1, opacity };
  const paint = new THREE.MeshLambertMaterial(seen);
  const glass = new THREE.MeshLambertMaterial(seen);
  const group = new THREE.Group();
  const { body, wheels } = told;
  group.add(new THREE.Mesh(lowerBody(body, wheels), paint));
  group.add(new THREE.Mesh(cabin(body, wheels), glass));
  const [rear, front] = roofEnds(body, wheels), size = [front - rear, (body.width - 0.1) * TAPER, 0.03];
  const roof = new THREE.Mesh(new THREE.BoxGeometry(...size), paint);
  roof.position.set((rear + front) / 2, 0, body.top + 0.005);
  group.add(roof);
  if (opacity === 1) group.add(details(body));
  group.traverse((each) => { each.castShadow = opacity === 1; });
  group.position.y = body.aside;
  Object.assign(group.userData, { paint, glass });
  return group;
}

/** A tire with rim and spokes; its axle is the y axis. */
function wheelOf(told, opacity) {
  const seen = { transparent: opacity < 1, opacity }, { radius, width } = told;
  const rubber = new THREE.MeshLambertMaterial({ color: 0x23262b, ...seen });
  const metal = new THREE.MeshLambertMaterial({ color: 0xc3c9d0, ...seen });
  const marked = new THREE.MeshLambertMaterial({ color: 0xf2bf1a, ...seen });
  const group = new THREE.Group();
  group.add(new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, width, 40), rubber));
  const rim = new THREE.CylinderGeometry(0.62 * radius, 0.62 * radius, width + 0.006, 32);
  group.add(new THREE.Mesh(rim, new THREE.MeshLambertMaterial({ color: 0x4a5057, ...seen })));
  for (let k = 0; k < 5; k++) {
    const spoke = new THREE.BoxGeometry(0.58 * radius, width + 0.016, 0.13 * radius);
    spoke.translate(0.3 * radius, 0, 0).rotateY((2 * Math.PI * k) / 5);
    group.add(new THREE.Mesh(spoke, k ? metal : marked));
  }
  group.traverse((each) => { each.castShadow = opacity === 1; });
  return group;
}
