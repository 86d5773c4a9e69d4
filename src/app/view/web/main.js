// The player: fetches the match, keeps the time, and shows the state at that time.
// Address: ?t=SECONDS&paused=1&speed=2&camera=above&follow=left7 opens the page in that state.
import * as THREE from '/three/build/three.module.js';
import {Belief} from './belief.js';
import {Cameras} from './cameras.js';
import {Robots} from './robots.js';
import {Stage, kTeamColors} from './stage.js';
import {Timeline, clockText} from './timeline.js';
import {escapeHtml, table} from './text.js';
import {Track, slotName} from './track.js';

const kPollInterval = 200;   // ms between two questions for news
const kLiveDelay = 0.35;     // s that a live match lags, so that there is always a next row
const byId = id => document.getElementById(id);
const kModes = ['Before kick-off', 'Kick-off left', 'Kick-off right', 'Play on', 'Kick-in left', 'Kick-in right',
                'Corner kick left', 'Corner kick right', 'Goal kick left', 'Goal kick right', 'Offside left',
                'Offside right', 'Game over', 'Goal left', 'Goal right', 'Free kick left', 'Free kick right',
                'Direct free kick left', 'Direct free kick right', 'Pass left', 'Pass right', ''];

// What tests and people with a closed console want to know.
let errors = 0;
function fail(error) {
  document.body.dataset.errors = String(++errors);
  byId('message').textContent = String(error && error.message || error);
}
window.addEventListener('error', event => fail(event.error || event.message));
window.addEventListener('unhandledrejection', event => fail(event.reason));

class Player {
  constructor() {
    this.track = new Track();
    this.place = 0;        // in rows, with a fraction
    this.playing = true;
    this.speed = 1;
    this.atEnd = false;    // goes with a live match
    this.followed = -1;    // slot of the robot
    this.frameTimes = [];
  }

  async start() {
    const [shapes] = await Promise.all([fetch('/shapes').then(reply => reply.json()), this.track.poll()]);
    this.live = this.track.header.live !== '';
    this.atEnd = this.live;
    byId('live').hidden = !this.live;
    byId('source').textContent = this.track.header.source;
    while (this.track.frames === 0) {
      byId('message').textContent = this.track.header.live;
      await new Promise(done => setTimeout(done, kPollInterval));
      await this.track.poll();
    }
    byId('message').textContent = '';
    this.stage = new Stage(byId('stage'), this.track.header.field);
    this.robots = new Robots(this.stage.scene, shapes);
    this.cameras = new Cameras(this.stage);
    this.belief = new Belief(this.stage.scene);
    this.timeline = new Timeline(byId('timeline'), byId('tip'), this.track, place => this.seek(place));
    this.listen();
    this.openAs(new URLSearchParams(location.search));
    if (this.live) this.pollOn();
    this.last = performance.now();
    requestAnimationFrame(now => this.frame(now));
  }

  async pollOn() {
    for (;;) {
      await new Promise(done => setTimeout(done, kPollInterval));
      try {
        await this.track.poll();
        byId('message').textContent = this.track.header && this.track.header.live.startsWith('live')
          ? '' : this.track.header ? this.track.header.live : '';
      } catch (error) {
        byId('message').textContent = 'nonet view has ended';
      }
    }
  }

  openAs(query) {
    if (query.has('t')) this.seek(Number(query.get('t')) / this.track.step);
    if (query.has('paused')) this.playing = false;
    if (query.has('speed')) this.setSpeed(Number(query.get('speed')));
    const follow = /^(left|right)(\d+)$/.exec(query.get('follow') || '');
    if (follow) this.follow((follow[1] === 'left' ? 0 : 11) + Number(follow[2]) - 1);
    this.setCamera(query.get('camera') || 'free');
  }

  // -- what the user does

  listen() {
    const stage = byId('stage');
    byId('play').onclick = () => this.togglePlay();
    byId('back').onclick = () => this.seek(this.place - 1 / this.track.step);
    byId('forward').onclick = () => this.seek(this.place + 1 / this.track.step);
    byId('live').onclick = () => { this.atEnd = true; this.playing = true; this.setSpeed(1); };
    byId('speed').oninput = () => this.setSpeed(10 ** Number(byId('speed').value));
    document.querySelectorAll('[data-camera]').forEach(button => {
      button.onclick = () => this.setCamera(button.dataset.camera);
    });
    window.addEventListener('keydown', event => this.key(event));
    let pressed = null;
    stage.addEventListener('pointerdown', event => { pressed = [event.clientX, event.clientY]; });
    stage.addEventListener('pointerup', event => {
      if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 5) this.click(event);
    });
  }

  key(event) {
    const actions = {
      ' ': () => this.togglePlay(),
      ArrowLeft: () => this.seek(this.place - 1 / this.track.step),
      ArrowRight: () => this.seek(this.place + 1 / this.track.step),
      ',': () => { this.playing = false; this.seek(Math.ceil(this.place) - 1); },
      '.': () => { this.playing = false; this.seek(Math.floor(this.place) + 1); },
      '-': () => this.setSpeed(this.speed / 1.5),
      '+': () => this.setSpeed(this.speed * 1.5),
      '1': () => this.setCamera('free'),
      '2': () => this.setCamera('ball'),
      '3': () => this.setCamera('eye'),
      '4': () => this.setCamera('above'),
      Escape: () => this.follow(-1),
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    actions[event.key]();
  }

  click(event) {
    const bounds = byId('stage').getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera({x: (event.clientX - bounds.left) / bounds.width * 2 - 1,
                       y: 1 - (event.clientY - bounds.top) / bounds.height * 2}, this.stage.camera);
    const slot = this.robots.pick(ray.ray);
    if (slot >= 0) this.follow(slot);
  }

  togglePlay() {
    if (!this.playing && this.place >= this.track.frames - 1) this.seek(0);
    this.playing = !this.playing;
    if (!this.playing) this.atEnd = false;
  }

  seek(place) {
    this.place = Math.max(0, Math.min(this.track.frames - 1, place));
    this.atEnd = false;
  }

  setSpeed(speed) {
    this.speed = Math.max(0.1, Math.min(20, speed));
    byId('speed').value = String(Math.log10(this.speed));
    byId('speedText').textContent = `${this.speed < 3 ? this.speed.toFixed(1) : Math.round(this.speed)}×`;
    if (this.speed !== 1) this.atEnd = false;
  }

  setCamera(mode) {
    if (mode === 'eye' && this.followed < 0) this.follow(this.nearestToBall());
    this.cameras.set(mode);
    document.querySelectorAll('[data-camera]').forEach(button => {
      button.classList.toggle('on', button.dataset.camera === mode);
    });
  }

  follow(slot) {
    this.followed = slot;
    byId('followed').hidden = slot < 0;
    if (slot < 0) {
      if (this.cameras.mode === 'eye') this.setCamera('free');
      return;
    }
    if (this.cameras.mode === 'free') {
      const torso = new THREE.Vector3();
      this.track.torso(this.place, slot, torso);
      this.cameras.come(torso, 4.5);
    }
  }

  nearestToBall() {
    const ball = new THREE.Vector3(), torso = new THREE.Vector3();
    this.track.ball(this.place, ball);
    let best = -1, nearest = Infinity;
    for (let slot = 0; slot < this.track.header.slots; ++slot) {
      if (this.track.robotType(this.place, slot) < 0) continue;
      this.track.torso(this.place, slot, torso);
      if (torso.distanceTo(ball) < nearest) [best, nearest] = [slot, torso.distanceTo(ball)];
    }
    return best;
  }

  // -- what is shown

  frame(now) {
    const seconds = Math.min(0.25, (now - this.last) / 1000);
    this.last = now;
    if (this.track.frames > 0) {
      this.advance(seconds);
      this.show(seconds);
      this.measure(now);
    }
    requestAnimationFrame(later => this.frame(later));
  }

  advance(seconds) {
    if (!this.playing) return;
    const end = this.track.frames - 1;
    this.place = Math.min(end, this.place + seconds * this.speed / this.track.step);
    if (this.atEnd) {
      const goal = Math.max(0, end - kLiveDelay / this.track.step);
      const behind = (goal - this.place) * this.track.step;
      // Far behind: jump; else run a little faster or slower until the place is right.
      this.place = Math.abs(behind) > 1.5 ? goal : this.place + 0.1 * (goal - this.place);
    } else if (this.place >= end && !this.live) {
      this.playing = false;
    }
  }

  show(seconds) {
    const hidden = this.cameras.mode === 'eye' ? this.followed : -1;
    this.stage.showBall(this.track, this.place, byId('trail').checked);
    this.robots.show(this.track, this.place, {
      labels: byId('labels').checked, followed: this.followed, hidden, eye: this.stage.camera.position});
    const trace = this.belief.show(this.track, this.place, this.followed);
    this.cameras.update(seconds, this.robots, this.followed);
    if (this.hasChanged()) this.stage.render();
    this.timeline.draw(this.place);
    this.showBoard();
    if (this.followed >= 0) this.showFollowed(trace);
    document.body.dataset.state = 'ready';
  }

  // A picture that stands still is not drawn again: laptops stay cool.
  hasChanged() {
    const {camera, renderer} = this.stage;
    const {clientWidth, clientHeight} = renderer.domElement;
    const seen = [this.place, this.followed, this.belief.version, byId('labels').checked, byId('trail').checked, clientWidth, clientHeight,
                  camera.fov, ...camera.position.toArray(), ...camera.quaternion.toArray()].join();
    const changed = seen !== this.seen;
    this.seen = seen;
    return changed;
  }

  showBoard() {
    const game = this.track.game(this.place);
    const [left, right] = this.track.teams(this.place);
    setText('teamLeft', left);
    setText('teamRight', right);
    setText('score', `${game.left} : ${game.right}`);
    setText('clock', `${clockText(game.time)}  ·  half ${game.half}  ·  ${kModes[game.mode] || ''}`);
    setText('time', `${clockText(this.place * this.track.step)} / ${clockText((this.track.frames - 1) * this.track.step)}`);
    setText('play', this.playing ? '❚❚' : '▶');
    byId('live').classList.toggle('on', this.atEnd);
    Object.assign(document.body.dataset, {score: `${game.left}:${game.right}`, time: game.time.toFixed(2)});
  }

  showFollowed(trace) {
    const {side, unum} = slotName(this.followed);
    const type = this.track.robotType(this.place, this.followed);
    const team = this.track.teams(this.place)[side - 1];
    const rows = [];
    if (type < 0) {
      rows.push(['', 'not on the field']);
    } else {
      const here = new THREE.Vector3(), before = new THREE.Vector3(), ball = new THREE.Vector3();
      const turn = new THREE.Quaternion();
      const span = 0.6 / this.track.step;
      this.track.torso(this.place, this.followed, here, turn);
      this.track.torso(Math.max(0, this.place - span), this.followed, before);
      this.track.ball(this.place, ball);
      const up = new THREE.Vector3(0, 0, 1).applyQuaternion(turn), forward = new THREE.Vector3(1, 0, 0).applyQuaternion(turn);
      const speed = Math.hypot(here.x - before.x, here.y - before.y) / 0.6;
      rows.push(['place', `${here.x.toFixed(2)}, ${here.y.toFixed(2)} m`],
                ['looks to', `${Math.round(Math.atan2(forward.y, forward.x) * 180 / Math.PI)}°`],
                ['speed', `${speed < 4 ? speed.toFixed(2) : '–'} m/s`],
                ['to the ball', `${Math.hypot(here.x - ball.x, here.y - ball.y).toFixed(2)} m`],
                ['posture', up.z > 0.8 ? 'upright' : up.z > 0.5 ? 'leans' : 'down']);
    }
    const html = `<h1><i style="background:${kTeamColors[side - 1]}"></i>${escapeHtml(team)} ${unum}` +
      `${type >= 0 ? ` <small>type ${type}</small>` : ''}<button title="Escape">✕</button></h1>${table(rows)}${trace ? this.belief.html(trace, this.track, this.place, this.followed) : ''}`;
    if (html === this.shownFollowed) return;
    this.shownFollowed = html;
    byId('followed').innerHTML = html;
    byId('followed').querySelector('button').onclick = () => this.follow(-1);
  }

  measure(now) {
    this.frameTimes.push(now);
    while (this.frameTimes[0] < now - 2000) this.frameTimes.shift();
    const span = now - this.frameTimes[0];
    if (span < 500) return;
    const rate = Math.round(1000 * (this.frameTimes.length - 1) / span);
    setText('rate', `${rate} fps`);
    document.body.dataset.rate = String(rate);
  }
}

function setText(id, text) {
  if (byId(id).textContent !== text) byId(id).textContent = text;
}

new Player().start().catch(fail);
