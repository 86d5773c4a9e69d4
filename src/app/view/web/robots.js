// All robots at once. Every kind of part (a torso shell, a foot, ...) is one instanced mesh for all robots, so
// that two teams of eleven need some thirty draw calls. Poses come from the torso and the joint angles by
// forward kinematics, with the shapes that the program's own robot model has.
import * as THREE from '/three/build/three.module.js';
import {canvasTexture, kTeamColors} from './stage.js';
import {slotName} from './track.js';

const kSlots = 22;

export class Robots {
  constructor(scene, shapes) {
    this.scene = scene;
    this.materials = {
      shell: new THREE.MeshPhongMaterial({color: '#eef1f4', shininess: 45, specular: '#555555'}),
      dark: new THREE.MeshPhongMaterial({color: '#2b323a', shininess: 30}),
      team: kTeamColors.map(color => new THREE.MeshPhongMaterial({color, shininess: 45, specular: '#444444'})),
      eye: kTeamColors.map(color => new THREE.MeshBasicMaterial(
        {color: new THREE.Color(color).lerp(new THREE.Color('#ffffff'), 0.5)})),
    };
    this.meshes = new Map();
    this.types = shapes.map(bodies => this.prepareType(bodies));
    this.world = Array.from({length: kSlots}, () => new Map());  // slot -> body -> Matrix4
    this.present = new Array(kSlots).fill(false);
    this.angles = new Float32Array(24);
    this.labels = Array.from({length: kSlots}, (_, slot) => this.addLabel(slot));
    this.ring = new THREE.Mesh(new THREE.RingBufferGeometry(0.26, 0.31, 48), new THREE.MeshBasicMaterial(
      {color: '#ffffff', transparent: true, opacity: 0.9, depthWrite: false}));
    this.ring.visible = false;
    scene.add(this.ring);
  }

  // Bodies in creation order, parents first, each with the constant parts of its transform and its looks.
  prepareType(bodies) {
    const index = new Map(bodies.map((body, i) => [body.name, i]));
    return bodies.map((body, i) => {
      const offset = new THREE.Vector3(...body.offset), anchor = new THREE.Vector3(...(body.anchor || [0, 0, 0]));
      return {
        name: body.name,
        parent: i === 0 ? -1 : index.get(body.parent),
        joint: body.joint === undefined ? -1 : body.joint,
        axis: body.axis ? new THREE.Vector3(...body.axis) : null,
        toJoint: new THREE.Matrix4().makeTranslation(...offset.clone().add(anchor).toArray()),
        fromJoint: new THREE.Matrix4().makeTranslation(...anchor.clone().negate().toArray()),
        looks: partsOf(body).map(part => ({...part, key: this.prepareMesh(body, part)})),
      };
    });
  }

  // The mesh (or the two of the teams) for this part; the same for all types where the sizes are the same.
  prepareMesh(body, part) {
    const key = `${body.name.replace(/^[rl](?=shoulder|upper|elbow|lower|hip|thigh|shank|ankle|foot|toe)/, '')}/` +
      `${part.name}/${body.size.join(',')}`;
    if (this.meshes.has(key)) return key;
    const material = this.materials[part.material];
    const perTeam = Array.isArray(material);
    const list = (perTeam ? material : [material]).map(paint => {
      const mesh = new THREE.InstancedMesh(part.geometry(), paint, kSlots * 2);
      mesh.customDepthMaterial = new THREE.MeshDepthMaterial({depthPacking: THREE.RGBADepthPacking});
      mesh.instanceMatrix.usage = THREE.DynamicDrawUsage;
      mesh.castShadow = part.shadow !== false;
      mesh.receiveShadow = true;
      mesh.frustumCulled = false;
      mesh.count = 0;
      this.scene.add(mesh);
      return mesh;
    });
    this.meshes.set(key, {list, perTeam});
    return key;
  }

  addLabel(slot) {
    const {side, unum} = slotName(slot);
    const texture = canvasTexture(128, 128, (pen) => {
      pen.fillStyle = kTeamColors[side - 1];
      pen.beginPath();
      pen.arc(64, 64, 56, 0, 7);
      pen.fill();
      pen.lineWidth = 7;
      pen.strokeStyle = 'rgba(255,255,255,0.9)';
      pen.stroke();
      pen.fillStyle = '#ffffff';
      pen.font = 'bold 70px system-ui, "DejaVu Sans", sans-serif';
      pen.textAlign = 'center';
      pen.textBaseline = 'middle';
      pen.fillText(String(unum), 64, 68);
    });
    const label = new THREE.Sprite(new THREE.SpriteMaterial({map: texture, depthTest: true, transparent: true}));
    label.visible = false;
    this.scene.add(label);
    return label;
  }

  show(track, place, {labels, followed, hidden, eye}) {
    for (const {list} of this.meshes.values()) list.forEach(mesh => { mesh.count = 0; });
    for (let slot = 0; slot < kSlots; ++slot) {
      const type = track.robotType(place, slot);
      this.present[slot] = type >= 0;
      this.labels[slot].visible = type >= 0 && labels && slot !== hidden;
      if (type < 0) continue;
      this.pose(track, place, slot, this.types[type]);
      if (slot !== hidden) this.draw(slot, this.types[type]);
      const torso = this.world[slot].get('torso').elements;
      const label = this.labels[slot];
      label.position.set(torso[12], torso[13], Math.max(torso[14], 0.2) + 0.42);
      label.scale.setScalar(0.09 + 0.011 * label.position.distanceTo(eye));  // readable from afar
    }
    for (const {list} of this.meshes.values()) {
      list.forEach(mesh => {
        mesh.visible = mesh.count > 0;
        mesh.instanceMatrix.needsUpdate = true;
      });
    }
    this.ring.visible = followed >= 0 && this.present[followed] && followed !== hidden;
    if (this.ring.visible) {
      const torso = this.world[followed].get('torso').elements;
      this.ring.position.set(torso[12], torso[13], 0.011);
    }
  }

  // Forward kinematics: child = parent * T(offset + anchor) * R(axis, angle) * T(-anchor).
  pose(track, place, slot, bodies) {
    const world = this.world[slot];
    track.torso(place, slot, kPosition, kOrientation);
    track.joints(place, slot, this.angles);
    bodies.forEach((body) => {
      if (!world.has(body.name)) world.set(body.name, new THREE.Matrix4());
      const matrix = world.get(body.name);
      if (body.parent < 0) {
        matrix.compose(kPosition, kOrientation, kOne);
        return;
      }
      matrix.copy(world.get(bodies[body.parent].name)).multiply(body.toJoint);
      if (body.joint >= 0) matrix.multiply(kTurn.makeRotationAxis(body.axis, this.angles[body.joint]));
      matrix.multiply(body.fromJoint);
    });
  }

  draw(slot, bodies) {
    const team = slot < kSlots / 2 ? 0 : 1;
    for (const body of bodies) {
      const matrix = this.world[slot].get(body.name);
      for (const look of body.looks) {
        const {list, perTeam} = this.meshes.get(look.key);
        const mesh = list[perTeam ? team : 0];
        kPlaced.copy(matrix);
        if (look.at) kPlaced.multiply(look.at);
        kPlaced.toArray(mesh.instanceMatrix.array, 16 * mesh.count++);
      }
    }
  }

  bodyMatrix(slot, body) {
    return this.world[slot].get(body);
  }

  // The robot nearest to the eye on this ray, -1 if there is none.
  pick(ray) {
    let best = -1, nearest = Infinity;
    for (let slot = 0; slot < kSlots; ++slot) {
      if (!this.present[slot]) continue;
      const center = kPosition.setFromMatrixPosition(this.world[slot].get('torso'));
      if (ray.distanceToPoint(center) > 0.32) continue;
      const distance = ray.origin.distanceTo(center);
      if (distance < nearest) [best, nearest] = [slot, distance];
    }
    return best;
  }
}

const kPosition = new THREE.Vector3(), kOrientation = new THREE.Quaternion(), kOne = new THREE.Vector3(1, 1, 1);
const kTurn = new THREE.Matrix4(), kPlaced = new THREE.Matrix4();

// How a body looks: parts with a material, a geometry and perhaps a place of their own. The sizes are the
// model's; joints, which are points there, get balls that one can see.
function partsOf(body) {
  const [x, y, z] = body.size;
  const name = body.name.replace(/^[rl](?=shoulder|upper|elbow|lower|hip|thigh|shank|ankle|foot|toe)/, '');
  const at = (px, py, pz) => new THREE.Matrix4().makeTranslation(px, py, pz);
  const ball = (radius) => () => new THREE.SphereBufferGeometry(radius, 20, 14);
  const box = (bx, by, bz, round) => () => roundedBox(bx, by, bz, round);
  switch (name) {
    case 'torso':
      return [{name: 'shell', material: 'shell', geometry: box(x, y * 1.25, z, 0.026)},
              {name: 'chest', material: 'team', geometry: box(x + 0.012, 0.09, 0.085, 0.02), at: at(0, 0, 0.028)},
              {name: 'belt', material: 'dark', geometry: box(x * 0.9, y * 1.1, 0.035, 0.014), at: at(0, 0, -z / 2)},
              {name: 'button', material: 'eye', geometry: ball(0.011), at: at(x / 2 + 0.003, 0, 0.03), shadow: false}];
    case 'neck':
      return [{name: 'neck', material: 'dark', geometry: () => {
        const pole = new THREE.CylinderBufferGeometry(0.022, 0.026, 0.08, 16);
        return pole.rotateX(Math.PI / 2);
      }}];
    case 'head': {
      const eye = () => new THREE.SphereBufferGeometry(0.0125, 12, 10);
      return [{name: 'skull', material: 'shell', geometry: () => new THREE.SphereBufferGeometry(x, 28, 20).scale(1, 1, 0.92)},
              {name: 'ears', material: 'team', geometry: () => new THREE.CylinderBufferGeometry(0.026, 0.026, 2 * x + 0.012, 20)},
              {name: 'eyeL', material: 'eye', geometry: eye, at: at(0.055, 0.026, 0.008), shadow: false},
              {name: 'eyeR', material: 'eye', geometry: eye, at: at(0.055, -0.026, 0.008), shadow: false},
              {name: 'camera', material: 'dark', geometry: () => new THREE.SphereBufferGeometry(0.009, 10, 8),
               at: at(0.058, 0, 0.03), shadow: false}];
    }
    case 'shoulder':
      return [{name: 'joint', material: 'team', geometry: ball(0.036)}];
    case 'upperarm':
      return [{name: 'shell', material: 'shell', geometry: box(x + 0.02, y * 0.8, z * 0.95, 0.022)}];
    case 'elbow':
      return [{name: 'joint', material: 'dark', geometry: ball(0.026)}];
    case 'lowerarm':
      return [{name: 'shell', material: 'shell', geometry: box(x, y * 0.95, z * 0.95, 0.02)},
              {name: 'hand', material: 'dark', geometry: ball(0.026), at: at(x / 2, 0, 0)}];
    case 'hip1':
      return [{name: 'joint', material: 'dark', geometry: ball(0.036)}];
    case 'thigh':
      return [{name: 'shell', material: 'shell', geometry: box(x, y, z, 0.024)},
              {name: 'band', material: 'team', geometry: box(x + 0.006, y + 0.006, 0.03, 0.012), at: at(0, 0, 0.01)}];
    case 'shank':
      return [{name: 'shell', material: 'shell', geometry: box(x, y * 0.9, z + 0.03, 0.024)},
              {name: 'knee', material: 'dark', geometry: ball(0.03), at: at(0.01, 0, z / 2)}];
    case 'ankle':
      return [{name: 'joint', material: 'dark', geometry: ball(0.028)}];
    case 'foot':
      return [{name: 'sole', material: 'dark', geometry: box(x, y, z, 0.009)},
              {name: 'cap', material: 'team', geometry: box(x * 0.82, y * 0.85, 0.026, 0.012), at: at(0, 0, 0.012)}];
    case 'toe':
      return [{name: 'sole', material: 'team', geometry: box(x, y, z + 0.008, 0.006)}];
    default:
      return [];
  }
}

// A box of these outer sizes with round edges, around the origin.
function roundedBox(x, y, z, round) {
  const r = Math.min(round, x / 2.2, y / 2.2, z / 2.2);
  const a = x / 2 - r, b = y / 2 - r;
  const outline = new THREE.Shape();
  const corner = r * 0.7;
  outline.moveTo(-a + corner, -b);
  outline.lineTo(a - corner, -b);
  outline.quadraticCurveTo(a, -b, a, -b + corner);
  outline.lineTo(a, b - corner);
  outline.quadraticCurveTo(a, b, a - corner, b);
  outline.lineTo(-a + corner, b);
  outline.quadraticCurveTo(-a, b, -a, b - corner);
  outline.lineTo(-a, -b + corner);
  outline.quadraticCurveTo(-a, -b, -a + corner, -b);
  const geometry = new THREE.ExtrudeBufferGeometry(outline, {
    depth: z - 2 * r, bevelEnabled: true, bevelThickness: r, bevelSize: r, bevelSegments: 3, curveSegments: 3});
  geometry.center();
  return geometry;
}
