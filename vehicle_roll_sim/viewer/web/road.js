/** The road of a run that is more than a plane: a mesh with the grid of the ground on it. */

/** Friction is told in hundredths. */
const HUNDREDTH = 0.01;
/** Share of the colour of a road without friction, or with twice as much. */
const MOST_COLOUR = 0.8;
/** Kinds of surface that the legend names one by one. */
const MOST_KINDS = 5;
/** The lines of the grid, fainter where they are narrower than a pixel; slopes stronger than by light alone. */
const LOOKS_OF_ROAD = `
  varying vec2 onGround;
  varying vec3 upright;
  uniform vec3 minor, major;
  float lines(float mesh, float width) {
    vec2 off = abs(fract(onGround / mesh - 0.5) - 0.5) * mesh, pixel = fwidth(onGround);
    vec2 share = clamp((0.5 * width - off) / pixel + 0.5, 0.0, 1.0) * min(width / pixel, vec2(1.0));
    return max(share.x, share.y);
  }
  float relief() {
    vec2 slope = upright.xy / max(upright.z, 0.1);
    return clamp(1.0 + 1.5 * dot(slope, vec2(-0.6, 0.8)) - 0.5 * length(slope), 0.4, 1.2);
  }
`;

class RoadSurface {
  constructor(scene) {
    const material = new THREE.MeshLambertMaterial({ vertexColors: true });
    this.lines = { minor: { value: new THREE.Color() }, major: { value: new THREE.Color() } };
    material.onBeforeCompile = (shader) => this.drawGrid(shader);
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false;
    this.friction = this.soft = [];
    scene.add(this.mesh);
  }

  drawGrid(shader) {
    Object.assign(shader.uniforms, this.lines);
    shader.vertexShader = `varying vec2 onGround; varying vec3 upright;\n${shader.vertexShader}`.replace(
      "#include <begin_vertex>", "#include <begin_vertex>\nonGround = position.xy; upright = normal;");
    shader.fragmentShader = (LOOKS_OF_ROAD + shader.fragmentShader).replace(
      "#include <color_fragment>", `#include <color_fragment>
      diffuseColor.rgb = mix(diffuseColor.rgb, minor, lines(${FINE.mesh}.0, ${FINE.width}));
      diffuseColor.rgb = mix(diffuseColor.rgb, major, lines(${COARSE.mesh}.0, ${COARSE.width}));
      diffuseColor.rgb *= relief();`);
  }

  /** Take over a mesh, or nothing. */
  hold(told) {
    this.mesh.geometry.dispose();
    this.mesh.geometry = new THREE.BufferGeometry();
    this.mesh.visible = Boolean(told);
    this.friction = told ? new Uint16Array(bytesOf(told.friction)) : [];
    this.soft = told ? new Uint8Array(bytesOf(told.soft)) : [];
    if (!told) return;
    const shared = new THREE.BufferGeometry();
    const vertices = new Float32Array(bytesOf(told.vertices));
    shared.setAttribute("position", new THREE.Float32BufferAttribute(vertices, 3));
    shared.setIndex([...new Uint16Array(bytesOf(told.triangles))]);
    shared.computeVertexNormals();
    this.mesh.geometry = shared.toNonIndexed(); // each triangle has a colour of its own
    shared.dispose();
  }

  /** Take the colours of the theme. */
  paint(colour) {
    this.lines.minor.value.set(colour("--minor"));
    this.lines.major.value.set(colour("--major"));
    const of = {}, colours = [];
    this.friction.forEach((friction, k) => {
      const key = 2 * friction + this.soft[k];
      of[key] ??= this.colour(friction * HUNDREDTH, this.soft[k], colour).toArray();
      colours.push(...of[key], ...of[key], ...of[key]);
    });
    if (!this.mesh.visible) return;
    this.mesh.geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
  }

  /** The ground's colour, with the more of another the further its friction is from 1. */
  colour(friction, isSoft, colour) {
    const found = new THREE.Color(colour(isSoft ? "--soil" : "--ground"));
    const share = MOST_COLOUR * Math.min(Math.abs(friction - 1), 1);
    return found.lerp(new THREE.Color(colour(friction < 1 ? "--slippery" : "--rough")), share);
  }

  /** Name and colour of the kinds of surface, if there is any but the usual one. */
  kinds(colour) {
    const frictions = [...new Set(this.friction)].sort((a, b) => a - b), last = frictions.length - 1;
    const some = last < MOST_KINDS ? frictions : [0, 0.25, 0.5, 0.75, 1].map((q) => frictions[Math.round(q * last)]);
    const isPlain = some.every((each) => each === 100);
    const kinds = isPlain ? [] : some.map((each) => [`friction × ${shown(each * HUNDREDTH, 2)}`, each, 0]);
    if (this.soft.includes(1)) kinds.push(["soft soil", 100, 1]);
    return kinds.map(([name, friction, isSoft]) => ({
      name, colour: `#${this.colour(friction * HUNDREDTH, isSoft, colour).getHexString()}`,
    }));
  }
}

/** List the kinds of surface with their colours. */
function surfaceLegend(parent, kinds) {
  parent.replaceChildren(...kinds.map(({ name, colour }) => {
    const item = element("li"), swatch = element("span", "", { className: "swatch" });
    swatch.style.background = colour;
    item.append(swatch, element("span", name));
    return item;
  }));
  parent.hidden = !kinds.length;
}
