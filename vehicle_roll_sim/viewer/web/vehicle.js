/** A run's vehicle in the scene: frames of ISO 8855, x forward, y left, z up, in m. */

/** m of an arrow for 1 N. */
const LENGTH_OF_FORCE = 0.25e-3;
/** Colours of the wheels, those of the layouts for RViz and Foxglove. */
const COLOURS_OF_WHEELS = [0x3f8fe0, 0xff9d2e, 0x35b35a, 0xe5484d];
const GHOST = 0.3;

/** An arrow of unit length along z that is drawn over everything. */
function arrowOf(colour) {
  const material = new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
  const group = new THREE.Group();
  group.shaft = new THREE.Mesh(new THREE.CylinderGeometry(0.022, 0.022, 1, 12).rotateX(Math.PI / 2), material);
  group.head = new THREE.Mesh(new THREE.ConeGeometry(0.065, 0.16, 16).rotateX(Math.PI / 2), material);
  for (const part of [group.shaft, group.head]) {
    part.renderOrder = 10;
    group.add(part);
  }
  return group;
}

class VehicleModel {
  constructor(recording, isGhost) {
    this.recording = recording;
    this.isGhost = isGhost;
    const told = recording.vehicle, opacity = isGhost ? GHOST : 1;
    this.group = new THREE.Group();
    this.chassis = new THREE.Group();
    this.level = new THREE.Group();
    this.level.position.z = told.height;
    for (const each of [this.chassis, this.level]) each.rotation.order = "ZYX";
    this.group.add(this.chassis, this.level);
    this.body = bodyOf(told, opacity);
    this.chassis.add(this.body);
    this.hubs = told.wheels.map((wheel) => this.hub(wheel, opacity));
    this.arrows = COLOURS_OF_WHEELS.map(arrowOf);
    this.centres = told.axles.map(() => this.ball(0x9b3fd1));
    this.centreOfGravity = this.ball(0xffffff);
    this.group.add(...this.arrows, ...this.centres, this.centreOfGravity);
  }

  /** The carrier of a wheel, the steered part in it, and in that the wheel; level without heave. */
  hub(told, opacity) {
    const hub = new THREE.Group();
    hub.rotation.order = "ZXY";
    hub.position.set(...told.place);
    hub.steered = new THREE.Group();
    hub.wheel = wheelOf(told, opacity);
    hub.steered.add(hub.wheel);
    hub.add(hub.steered);
    (this.recording.hasHeave ? this.chassis : this.level).add(hub);
    return hub;
  }

  ball(colour) {
    const material = new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    const ball = new THREE.Mesh(new THREE.SphereGeometry(0.05, 16, 12), material);
    ball.renderOrder = 11;
    return ball;
  }

  /** Take the colours of body and windows. */
  paint(colour, glass) {
    this.body.userData.paint.color.set(colour);
    this.body.userData.glass.color.set(glass);
  }

  /** Leave the scene, and release the memory on the graphics card. */
  leave(scene) {
    scene.remove(this.group);
    this.group.traverse((each) => {
      if (!each.isMesh) return;
      each.geometry.dispose();
      each.material.dispose();
    });
  }

  /** Place everything as at a time (s); hidden where the run has no position. */
  pose(time) {
    const at = (name) => this.recording.at(name, time), told = this.recording.vehicle;
    const [x, y, yaw, roll] = ["x", "y", "yaw", "roll"].map(at);
    this.group.visible = [x, y, yaw, roll].every(Number.isFinite);
    if (!this.group.visible) return;
    const known = (value, other) => (Number.isFinite(value) ? value : other);
    this.chassis.position.set(x, y, known(at("z"), told.height));
    this.chassis.rotation.set(roll, known(at("pitch"), 0), yaw);
    this.level.position.set(x, y, told.height);
    this.level.rotation.z = yaw;
    this.centreOfGravity.visible = !this.isGhost;
    this.centreOfGravity.position.copy(this.chassis.position);
    this.poseWheels(time, known);
    this.group.updateMatrixWorld(true);
    this.poseArrows(time, yaw);
    this.poseCentres(time, x, y, yaw);
  }

  poseWheels(time, known) {
    const { recording } = this, told = recording.vehicle;
    const compression = recording.wheels("suspension_compression", time);
    const angle = recording.wheels("wheel_angle", time);
    const front = known(recording.at("steering", time), 0);
    const rear = known(recording.at("rear_steering", time), 0);
    this.hubs.forEach((hub, i) => {
      const wheel = told.wheels[i], travel = known(compression[i] - wheel.compression, 0);
      const steering = (i < 2 ? front : rear) + wheel.toe, [x, y, z] = wheel.place;
      if (wheel.guide) {
        const by = (name) => tabulated(wheel.guide.travel, wheel.guide[name], travel);
        hub.position.set(x + by("ahead"), y + by("left"), z + travel);
        hub.rotation.set(wheel.camber + by("camber"), by("pitch"), by("toe"));
        hub.steered.rotation.z = steering;
      } else {
        hub.position.z = z + travel;
        hub.rotation.set(wheel.camber, 0, steering);
      }
      hub.wheel.rotation.y = known(angle[i], 0) % (2 * Math.PI);
    });
  }

  /** Centre of a wheel in the scene (m). */
  centre(i) {
    return new THREE.Vector3().setFromMatrixPosition(this.hubs[i].matrixWorld);
  }

  /** Lowest point of a wheel's middle plane, not below the ground. */
  contact(i, time) {
    const axle = new THREE.Vector3(0, 1, 0).transformDirection(this.hubs[i].steered.matrixWorld);
    const down = new THREE.Vector3(0, 0, -1).addScaledVector(axle, axle.z);
    if (down.lengthSq() < 1e-6) down.set(0, 0, -1);
    const point = this.centre(i).addScaledVector(down.normalize(), this.recording.vehicle.wheels[i].radius);
    const ground = this.recording.at(`ground_${WHEELS[i]}`, time);
    point.z = Math.max(point.z, Number.isFinite(ground) ? ground : 0);
    return point;
  }

  poseArrows(time, yaw) {
    const forces = ["longitudinal_force", "lateral_force", "normal_force"];
    const [ahead, left, up] = forces.map((name) => this.recording.wheels(name, time));
    const number = (value) => (Number.isFinite(value) ? value : 0);
    this.arrows.forEach((arrow, i) => {
      const force = new THREE.Vector3(number(ahead[i]), number(left[i]), number(up[i]));
      const length = force.length() * LENGTH_OF_FORCE;
      arrow.visible = !this.isGhost && length > 0.01;
      if (!arrow.visible) return;
      force.normalize().applyAxisAngle(new THREE.Vector3(0, 0, 1), yaw);
      arrow.position.copy(this.contact(i, time));
      arrow.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), force);
      arrow.shaft.scale.z = length;
      arrow.shaft.position.z = length / 2;
      arrow.head.position.z = length;
    });
  }

  /** The roll centres where the run has them, in the planes of the axles. */
  poseCentres(time, x, y, yaw) {
    this.recording.vehicle.axles.forEach((axle, k) => {
      const height = this.recording.at(`${axle.name}_roll_centre_height`, time);
      const place = this.recording.at(`${axle.name}_roll_centre_place`, time);
      const ball = this.centres[k];
      ball.visible = !this.isGhost && Number.isFinite(height + place);
      const offset = new THREE.Vector3(axle.x, place, 0).applyAxisAngle(new THREE.Vector3(0, 0, 1), yaw);
      ball.position.set(x + offset.x, y + offset.y, height);
    });
  }
}
