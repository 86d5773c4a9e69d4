// What stands still (field, goals, light) and the ball with its trail. World axes: x to the right goal, y left
// of that, z up; metres.
import * as THREE from '/three/build/three.module.js';

export const kTeamColors = ['#3b8eff', '#ff6a3d'];

const kLineWidth = 0.05;
const kTrailSeconds = 3;
const kTrailPoints = 90;

export class Stage {
  constructor(canvas, field) {
    this.field = field;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.gammaOutput = true;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.scene = new THREE.Scene();
    this.scene.background = gradient();
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.02, 200);
    this.camera.up.set(0, 0, 1);
    this.addLight();
    this.addGround();
    this.addLines();
    this.addGoal(-1);
    this.addGoal(1);
    this.addBall();
    this.addTrail();
  }

  get length() { return this.field.FieldLength || 30; }
  get width() { return this.field.FieldWidth || 20; }

  resize() {
    const canvas = this.renderer.domElement;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (this.shown && this.shown[0] === width && this.shown[1] === height) return;
    this.shown = [width, height];
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  render() {
    this.resize();
    this.renderer.render(this.scene, this.camera);
  }

  addLight() {
    this.scene.add(new THREE.HemisphereLight('#dcecff', '#5d7a52', 0.62));
    const sun = new THREE.DirectionalLight('#fff3df', 0.72);
    sun.position.set(-9, -14, 22);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    Object.assign(sun.shadow.camera, {left: -19, right: 19, top: 15, bottom: -15, near: 5, far: 50});
    sun.shadow.bias = -0.0006;
    this.scene.add(sun);
  }

  addGround() {
    const border = 3;
    const stripes = canvasTexture(64, 64, (pen) => {
      pen.fillStyle = '#3f8a45';
      pen.fillRect(0, 0, 64, 64);
      pen.fillStyle = '#469650';
      pen.fillRect(0, 0, 32, 64);
      for (let i = 0; i < 500; ++i) {  // blades, always the same
        pen.fillStyle = i % 2 ? 'rgba(0,0,0,0.05)' : 'rgba(255,255,255,0.04)';
        pen.fillRect((i * 37) % 64, (i * 53 + (i >> 3)) % 64, 1, 2);
      }
    });
    stripes.wrapS = stripes.wrapT = THREE.RepeatWrapping;
    stripes.repeat.set(this.length / 3, this.width / 3);
    stripes.anisotropy = 8;
    this.addPlane(this.length + 2 * border + 14, this.width + 2 * border + 14, -0.02, {color: '#0f2a18'});
    this.addPlane(this.length + 2 * border, this.width + 2 * border, -0.01, {color: '#1b4a26'});
    this.addPlane(this.length, this.width, 0, {map: stripes});
  }

  addPlane(x, y, z, look) {
    const plane = new THREE.Mesh(new THREE.PlaneBufferGeometry(x, y), new THREE.MeshLambertMaterial(look));
    plane.position.z = z;
    plane.receiveShadow = true;
    this.scene.add(plane);
  }

  addLines() {
    const white = new THREE.MeshLambertMaterial({color: '#f4f7f4', polygonOffset: true, polygonOffsetFactor: -2,
                                                 polygonOffsetUnits: -2});
    const add = (geometry, x, y) => {
      const line = new THREE.Mesh(geometry, white);
      line.position.set(x, y, 0.002);
      line.receiveShadow = true;
      this.scene.add(line);
    };
    const bar = (x0, y0, x1, y1) => add(new THREE.PlaneBufferGeometry(
      Math.abs(x1 - x0) + kLineWidth, Math.abs(y1 - y0) + kLineWidth), (x0 + x1) / 2, (y0 + y1) / 2);
    const x = this.length / 2, y = this.width / 2;
    bar(-x, -y, x, -y);
    bar(-x, y, x, y);
    bar(0, -y, 0, y);
    const depth = 1.8, half = (3.9 + (this.field.GoalWidth || 2.1)) / 2;  // of the penalty area
    for (const side of [-1, 1]) {
      bar(side * x, -y, side * x, y);
      bar(side * (x - depth), -half, side * (x - depth), half);
      bar(side * x, half, side * (x - depth), half);
      bar(side * x, -half, side * (x - depth), -half);
    }
    const radius = this.field.FreeKickDistance || 2;
    add(new THREE.RingBufferGeometry(radius - kLineWidth / 2, radius + kLineWidth / 2, 96), 0, 0);
    add(new THREE.CircleBufferGeometry(0.07, 24), 0, 0);
  }

  addGoal(side) {
    const width = this.field.GoalWidth || 2.1, height = this.field.GoalHeight || 0.8;
    const depth = this.field.GoalDepth || 0.6;
    const goal = new THREE.Group();
    goal.position.x = side * this.length / 2;
    goal.scale.x = side;
    const color = new THREE.Color(kTeamColors[side < 0 ? 0 : 1]).lerp(new THREE.Color('#ffffff'), 0.55);
    const paint = new THREE.MeshPhongMaterial({color, shininess: 60, side: THREE.DoubleSide});
    const tube = (ax, ay, az, bx, by, bz, radius) => {
      const a = new THREE.Vector3(ax, ay, az), b = new THREE.Vector3(bx, by, bz);
      const pole = new THREE.Mesh(new THREE.CylinderBufferGeometry(radius, radius, a.distanceTo(b), 14), paint);
      pole.position.copy(a).add(b).multiplyScalar(0.5);
      pole.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), b.sub(a).normalize());
      pole.castShadow = true;
      goal.add(pole);
    };
    const y = width / 2;
    tube(0, -y, 0, 0, -y, height, 0.035);
    tube(0, y, 0, 0, y, height, 0.035);
    tube(0, -y - 0.035, height, 0, y + 0.035, height, 0.035);
    for (const s of [-y, y]) {
      tube(0, s, height, depth, s, 0, 0.014);
      tube(0, s, 0, depth, s, 0, 0.014);
    }
    tube(depth, -y, 0, depth, y, 0, 0.014);
    goal.add(net([0, -y, height, 0, y, height, depth, y, 0, depth, -y, 0], 26, 12));
    for (const s of [-y, y]) goal.add(net([0, s, 0, 0, s, height, depth, s, 0, depth, s, 0], 10, 10));
    this.scene.add(goal);
  }

  addBall() {
    const radius = this.field.BallRadius || 0.042;
    const skin = canvasTexture(256, 128, (pen) => {
      pen.fillStyle = '#fbfbf8';
      pen.fillRect(0, 0, 256, 128);
      pen.fillStyle = '#1d2329';
      for (const [u, v] of [[0.1, 0.5], [0.35, 0.33], [0.35, 0.75], [0.6, 0.5], [0.85, 0.3], [0.85, 0.72], [0.5, 0.03],
                            [0.5, 0.97]]) {
        pen.beginPath();
        pen.ellipse(u * 256, v * 128, v < 0.1 || v > 0.9 ? 256 : 17, 12, 0, 0, 7);
        pen.fill();
      }
    });
    this.ball = new THREE.Mesh(new THREE.SphereBufferGeometry(radius, 28, 20),
                               new THREE.MeshPhongMaterial({map: skin, shininess: 50}));
    this.ball.castShadow = true;
    this.halo = new THREE.Mesh(new THREE.RingBufferGeometry(0.13, 0.16, 40), new THREE.MeshBasicMaterial(
      {color: '#fff36b', transparent: true, opacity: 0.8, depthWrite: false}));
    this.scene.add(this.ball, this.halo);
  }

  // A strip on the ground that fades towards its old end.
  addTrail() {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(kTrailPoints * 6), 3));
    geometry.setAttribute('age', new THREE.BufferAttribute(new Float32Array(kTrailPoints * 2), 1));
    const index = [];
    for (let i = 0; i + 1 < kTrailPoints; ++i) index.push(2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 1, 2 * i + 3, 2 * i + 2);
    geometry.setIndex(index);
    const material = new THREE.ShaderMaterial({
      transparent: true, depthWrite: false, side: THREE.DoubleSide,
      vertexShader: `attribute float age; varying float fade;
        void main() { fade = 1.0 - age; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
      fragmentShader: 'varying float fade; void main() { gl_FragColor = vec4(1.0, 0.93, 0.3, 0.75 * fade * fade); }'});
    this.trail = new THREE.Mesh(geometry, material);
    this.trail.frustumCulled = false;
    this.scene.add(this.trail);
  }

  showBall(track, place, withTrail) {
    track.ball(place, this.ball.position, this.ball.quaternion);
    this.halo.position.set(this.ball.position.x, this.ball.position.y, 0.012);
    this.trail.visible = withTrail;
    if (withTrail) this.showTrail(track, place);
  }

  showTrail(track, place) {
    const positions = this.trail.geometry.attributes.position, ages = this.trail.geometry.attributes.age;
    const point = new THREE.Vector3(), before = this.ball.position.clone();
    const side = new THREE.Vector3(0, 1, 0);
    const radius = this.field.BallRadius || 0.042;
    let broken = false;
    for (let i = 0; i < kTrailPoints; ++i) {
      const age = i / (kTrailPoints - 1);
      track.ball(Math.max(0, place - age * kTrailSeconds / track.step), point);
      const way = point.clone().sub(before);
      broken = broken || way.length() > 1.2;  // the ball was carried
      if (broken) point.copy(before);
      if (!broken && way.length() > 0.004) side.set(-way.y, way.x, 0).normalize();
      const half = radius * (1 - 0.7 * age);
      positions.setXYZ(2 * i, point.x + side.x * half, point.y + side.y * half, Math.max(0.008, point.z - radius));
      positions.setXYZ(2 * i + 1, point.x - side.x * half, point.y - side.y * half, Math.max(0.008, point.z - radius));
      ages.setX(2 * i, broken ? 1 : age);
      ages.setX(2 * i + 1, broken ? 1 : age);
      before.copy(point);
    }
    positions.needsUpdate = ages.needsUpdate = true;
  }
}

export function canvasTexture(width, height, draw) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  draw(canvas.getContext('2d'), width, height);
  const texture = new THREE.CanvasTexture(canvas);
  texture.encoding = THREE.sRGBEncoding;
  return texture;
}

function gradient() {
  return canvasTexture(4, 256, (pen) => {
    const colors = pen.createLinearGradient(0, 0, 0, 256);
    colors.addColorStop(0, '#0d1a2b');
    colors.addColorStop(0.55, '#3c5a78');
    colors.addColorStop(1, '#1c2f27');
    pen.fillStyle = colors;
    pen.fillRect(0, 0, 4, 256);
  });
}

// A net of lines over the four-sided face with these corners.
function net(corners, columns, rows) {
  const corner = (i) => new THREE.Vector3(...corners.slice(3 * i, 3 * i + 3));
  const [a, b, c, d] = [0, 1, 2, 3].map(corner);
  const points = [];
  for (let i = 0; i <= columns; ++i) {
    points.push(a.clone().lerp(b, i / columns), d.clone().lerp(c, i / columns));
  }
  for (let i = 0; i <= rows; ++i) points.push(a.clone().lerp(d, i / rows), b.clone().lerp(c, i / rows));
  return new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(points),
                                new THREE.LineBasicMaterial({color: '#ffffff', transparent: true, opacity: 0.28}));
}
