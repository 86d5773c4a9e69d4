// Where the match is looked at from.
import * as THREE from '/three/build/three.module.js';
import {OrbitControls} from '/three/examples/jsm/controls/OrbitControls.js';

const kFollowTime = 0.25;  // s in which the camera comes up with what it follows

export class Cameras {
  constructor(stage) {
    this.stage = stage;
    this.mode = 'free';
    this.controls = new OrbitControls(stage.camera, stage.renderer.domElement);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = 0.495 * Math.PI;
    this.controls.minDistance = 0.6;
    this.controls.maxDistance = 60;
    this.controls.screenSpacePanning = false;
    this.home();
  }

  home() {
    this.stage.camera.position.set(0, -21, 14.5);
    this.controls.target.set(0, -1.6, 0);
  }

  set(mode) {
    if (mode === this.mode) return;
    const camera = this.stage.camera;
    if (this.mode === 'eye' || this.mode === 'above') {
      camera.up.set(0, 0, 1);
      this.home();
    }
    this.mode = mode;
    this.controls.enabled = mode === 'free' || mode === 'ball';
    camera.fov = mode === 'eye' ? 75 : 45;
    camera.updateProjectionMatrix();
    if (mode === 'ball') this.come(this.stage.ball.position, 6.5);
  }

  // Close to a point, from where the camera is now.
  come(point, distance) {
    const way = this.stage.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.set(point.x, point.y, 0.2);
    this.stage.camera.position.copy(this.controls.target).addScaledVector(way, distance);
  }

  // `robots`, `followed`: for the eye and for the free camera that goes with a robot.
  update(seconds, robots, followed) {
    const camera = this.stage.camera;
    if (this.mode === 'eye' && followed >= 0 && robots.present[followed]) {
      this.lookThrough(robots.bodyMatrix(followed, 'head'));
      return;
    }
    if (this.mode === 'above') {
      const shown = Math.max((this.stage.length + 3) / camera.aspect, this.stage.width + 8);
      const height = shown / 2 / Math.tan(camera.fov / 2 * Math.PI / 180);
      camera.up.set(0, 1, 0);
      camera.position.set(0, -1.2, height);
      camera.lookAt(0, -1.2, 0);
      return;
    }
    const goal = new THREE.Vector3();
    if (this.mode === 'ball') {
      goal.copy(this.stage.ball.position).setZ(0.2);
    } else if (this.mode === 'free' && followed >= 0 && robots.present[followed]) {
      goal.setFromMatrixPosition(robots.bodyMatrix(followed, 'torso')).setZ(0.3);
    } else {
      this.controls.update();
      return;
    }
    const way = goal.sub(this.controls.target).multiplyScalar(1 - Math.exp(-seconds / kFollowTime));
    this.controls.target.add(way);
    camera.position.add(way);
    this.controls.update();
  }

  // The head looks along its x axis, its z axis is up.
  lookThrough(head) {
    const x = new THREE.Vector3(), y = new THREE.Vector3(), z = new THREE.Vector3();
    head.extractBasis(x, y, z);
    const camera = this.stage.camera;
    camera.position.setFromMatrixPosition(head).addScaledVector(x, 0.07);
    camera.up.copy(z);
    camera.lookAt(camera.position.clone().add(x));
  }
}
