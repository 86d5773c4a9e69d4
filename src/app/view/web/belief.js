// What the followed robot believes, drawn beside the truth, from its decision trace. The trace speaks in the
// own team's field frame; `side` (1 or -1) turns that into the world.
import * as THREE from '/three/build/three.module.js';
import {kTeamColors} from './stage.js';
import {table} from './text.js';

const kColor = '#ff5bd6';    // of everything believed
const kHeight = 0.014;       // m above the ground, so that lines do not flicker
const kLongestGap = 0.5;     // s of the game between the picture and the cycle shown for it
const kSigmas = 2;
const kMostParticles = 300;

export class Belief {
  constructor(scene) {
    this.group = new THREE.Group();
    this.group.visible = false;
    scene.add(this.group);
    this.traces = new Map();   // player -> runs of cycles, or null while they are on the way
    this.version = 0;          // grows when something has arrived
    const glass = new THREE.MeshBasicMaterial({color: kColor, transparent: true, opacity: 0.35, depthWrite: false,
                                               side: THREE.DoubleSide});
    const line = new THREE.LineBasicMaterial({color: kColor});
    this.ellipse = this.add(new THREE.Mesh(new THREE.CircleBufferGeometry(1, 40), glass));
    this.arrow = this.add(new THREE.Mesh(arrowGeometry(), new THREE.MeshBasicMaterial({color: kColor, side: THREE.DoubleSide})));
    this.ball = this.add(new THREE.Mesh(new THREE.SphereBufferGeometry(0.06, 20, 14), glass));
    this.ballSpread = this.add(new THREE.Mesh(new THREE.CircleBufferGeometry(1, 40), glass));
    this.places = new THREE.BufferAttribute(new Float32Array(3 * kMostParticles), 3);
    this.particles = this.add(new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial(
      {color: kColor, size: 3, sizeAttenuation: false, transparent: true, opacity: 0.7, depthWrite: false})));
    this.particles.geometry.setAttribute('position', this.places);
    this.particles.frustumCulled = false;
    this.target = this.add(new THREE.Mesh(new THREE.RingBufferGeometry(0.1, 0.14, 4),
                                          new THREE.MeshBasicMaterial({color: kColor, side: THREE.DoubleSide})));
    this.way = this.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(
      [new THREE.Vector3(), new THREE.Vector3()]), line));
    this.way.frustumCulled = false;
    this.players = Array.from({length: 22}, (_, slot) => this.add(new THREE.Mesh(
      new THREE.RingBufferGeometry(0.17, 0.2, 28), new THREE.MeshBasicMaterial(
        {color: kTeamColors[slot < 11 ? 0 : 1], transparent: true, opacity: 0.8, depthWrite: false}))));
  }

  add(mesh) {
    this.group.add(mesh);
    return mesh;
  }

  // The cycle that belongs to the picture, if there is one; it is drawn.
  show(track, place, slot) {
    // Teams may change sides: the trace is that of the player who is in this slot then.
    const team = slot >= 0 ? track.teams(place)[slot < 11 ? 0 : 1] : '';
    const cycle = slot >= 0 ? this.cycleAt(team, slot % 11 + 1, track.gameTime(place)) : null;
    this.group.visible = Boolean(cycle);
    if (cycle) this.draw(cycle, slot < 11 ? 0 : 11);
    return cycle;
  }

  cycleAt(team, unum, time) {
    const player = `team=${encodeURIComponent(team)}&unum=${unum}`;
    if (!this.traces.has(player)) this.fetch(player);
    const runs = this.traces.get(player) || [];
    const run = runs.findLast(cycles => cycles[0].game_time <= time + kLongestGap &&
                                        cycles[cycles.length - 1].game_time >= time - kLongestGap);
    return run ? cycleIn(run, time) : null;
  }

  async fetch(player) {
    this.traces.set(player, null);
    const reply = await fetch(`/trace?${player}`);
    this.traces.set(player, reply.ok ? runsOf(await reply.json()) : []);
    ++this.version;
  }

  draw(cycle, firstSlot) {
    const [x, y, heading] = inWorld(cycle.pose, cycle.side);
    const turn = (heading || 0) * Math.PI / 180;
    this.arrow.position.set(x, y, kHeight + 0.004);
    this.arrow.rotation.z = turn;
    spread(this.ellipse, x, y, cycle.covariance);
    this.drawParticles(cycle);
    this.ball.visible = this.ballSpread.visible = Boolean(cycle.ball);
    if (cycle.ball) {
      const [bx, by] = inWorld(cycle.ball.at, cycle.side);
      this.ball.position.set(bx, by, Math.max(0.042, cycle.ball.at[2]));
      spread(this.ballSpread, bx, by, cycle.ball.covariance);
    }
    const goal = cycle.request.target;
    this.target.visible = this.way.visible = Boolean(goal);
    if (goal) {
      const [gx, gy] = inWorld(goal, cycle.side);
      this.target.position.set(gx, gy, kHeight);
      this.way.geometry.attributes.position.setXYZ(0, x, y, kHeight);
      this.way.geometry.attributes.position.setXYZ(1, gx, gy, kHeight);
      this.way.geometry.attributes.position.needsUpdate = true;
    }
    this.players.forEach(ring => { ring.visible = false; });
    for (const [list, first] of [[cycle.mates, firstSlot], [cycle.opponents, 11 - firstSlot]]) {
      for (const player of list) {
        const [px, py] = inWorld(player.at, cycle.side);
        const ring = this.players[first + player.unum - 1];
        ring.visible = true;
        ring.position.set(px, py, kHeight - 0.002);
      }
    }
  }

  drawParticles(cycle) {
    if (cycle === this.drawnCycle) return;
    this.drawnCycle = cycle;
    const particles = (cycle.particles || []).slice(0, kMostParticles);
    particles.forEach((one, i) => this.places.setXYZ(i, cycle.side * one[0], cycle.side * one[1], kHeight + 0.002));
    this.places.needsUpdate = true;
    this.particles.geometry.setDrawRange(0, particles.length);
  }

  // The panel: why it acts, and how far its belief is from the truth.
  html(cycle, track, place, slot) {
    const rows = [['role', cycle.role]];
    if (cycle.reason) rows.push(['reason', cycle.reason]);
    rows.push(['wants', cycle.request.skill || cycle.request.kind]);
    if (cycle.request.target) rows.push(['there', place2(cycle.request.target)]);
    rows.push(['head', cycle.head]);
    const truth = new THREE.Vector3(), ball = new THREE.Vector3();
    track.torso(place, slot, truth);
    track.ball(place, ball);
    const [x, y] = inWorld(cycle.pose, cycle.side);
    const sigma = Math.sqrt(Math.max(cycle.covariance[0], cycle.covariance[2]));
    const belief = [['own place', `${metres(Math.hypot(x - truth.x, y - truth.y))} off, σ ${metres(sigma)}`]];
    if (cycle.particles) belief.push(['particles', String(cycle.particles.length)]);
    if (!cycle.localized) belief.push(['', 'not localized']);
    if (cycle.ball) {
      const [bx, by] = inWorld(cycle.ball.at, cycle.side);
      belief.push(['ball', `${metres(Math.hypot(bx - ball.x, by - ball.y))} off`],
                  ['ball seen', cycle.ball.seen === null ? 'never' : `${cycle.ball.seen.toFixed(2)} s ago`]);
    } else {
      belief.push(['ball', 'not known']);
    }
    belief.push(['players known', `${cycle.mates.length} + ${cycle.opponents.length}`]);
    let html = `<h2>Why</h2>${table(rows)}<h2>Belief</h2>${table(belief)}`;
    if (cycle.candidates) {
      html += `<h2>Candidates</h2>${table(cycle.candidates.map(one => [one.name, Number(one.value).toFixed(3)]))}`;
    }
    return html;
  }
}

// The game's clock goes back where a server was started anew: each time another run begins.
function runsOf(cycles) {
  const runs = [];
  for (const cycle of cycles) {
    const run = runs[runs.length - 1];
    if (run && cycle.game_time >= run[run.length - 1].game_time) run.push(cycle); else runs.push([cycle]);
  }
  return runs;
}

function cycleIn(cycles, time) {
  let low = 0, high = cycles.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (cycles[middle].game_time <= time + 1e-3) low = middle; else high = middle - 1;
  }
  // While the clock stands, before a kick-off, it does not tell which of many cycles belongs to the picture.
  const stands = [low - 1, low + 1].some(i => cycles[i] && cycles[i].game_time === cycles[low].game_time);
  return !stands && Math.abs(cycles[low].game_time - time) < kLongestGap ? cycles[low] : null;
}

function inWorld(place, side) {
  return [side * place[0], side * place[1], place.length > 2 ? place[2] + (side < 0 ? 180 : 0) : undefined];
}

function place2(place) {
  return `${place[0].toFixed(2)}, ${place[1].toFixed(2)} m`;
}

function metres(value) {
  return value < 1 ? `${(100 * value).toFixed(1)} cm` : `${value.toFixed(2)} m`;
}

// Lays a unit circle over the ellipse of two sigmas: axes and angle of a symmetric 2 x 2 matrix. Half a turn
// changes neither.
function spread(mesh, x, y, [xx, xy, yy]) {
  const middle = (xx + yy) / 2, difference = Math.hypot((xx - yy) / 2, xy);
  mesh.position.set(x, y, kHeight - 0.001);
  mesh.rotation.z = 0.5 * Math.atan2(2 * xy, xx - yy);
  mesh.scale.set(kSigmas * Math.sqrt(Math.max(1e-6, middle + difference)),
                 kSigmas * Math.sqrt(Math.max(1e-6, middle - difference)), 1);
}

// Flat, along x.
function arrowGeometry() {
  const shape = new THREE.Shape();
  shape.moveTo(0.32, 0);
  shape.lineTo(-0.12, 0.13);
  shape.lineTo(-0.04, 0);
  shape.lineTo(-0.12, -0.13);
  return new THREE.ShapeBufferGeometry(shape);
}
