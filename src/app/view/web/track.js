// The rows of the match as the server sends them, and the state between two of them. What a row holds is
// written in include/nonet/app/view/track.h.
import * as THREE from '/three/build/three.module.js';

const kJump = 5.0;  // m/s: what moves faster has been carried there, nothing is drawn in between

export class Track {
  constructor() {
    this.clear();
  }

  clear() {
    this.frames = 0;
    this.events = [];
    this.header = null;
    this.rows = new Float32Array(0);
  }

  // Fetches what is new. True if there is anything.
  async poll() {
    const reply = await fetch(`/track?from=${this.frames}&events=${this.events.length}`);
    if (!reply.ok) throw new Error(`the server answers ${reply.status}`);
    const data = await reply.arrayBuffer();
    const length = new DataView(data).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
    if (header.from < this.frames || header.eventsFrom !== this.events.length) {
      this.clear();  // nonet view was started again
      return false;
    }
    this.header = header;
    this.append(new Float32Array(data, 4 + length));
    this.events.push(...header.events);
    const grown = header.frames > this.frames;
    this.frames = header.frames;
    return grown;
  }

  append(rows) {
    const used = this.frames * this.header.row;
    if (used + rows.length > this.rows.length) {
      const larger = new Float32Array(this.frames === 0 ? rows.length : 2 * (used + rows.length));
      larger.set(this.rows.subarray(0, used));
      this.rows = larger;
    }
    this.rows.set(rows, used);
  }

  get step() {
    return this.header.step;
  }

  value(frame, column) {
    return this.rows[frame * this.header.row + column];
  }

  clampFrame(place) {
    return Math.max(0, Math.min(this.frames - 1, Math.floor(place)));
  }

  // What counts as one state: the row at or before `place`.
  game(place) {
    const frame = this.clampFrame(place);
    const [time, mode, half, left, right] = [0, 1, 2, 3, 4].map(column => this.value(frame, column));
    return {time, mode, half, left, right};
  }

  // What the teams on the left and on the right are called then: they may change sides.
  teams(place) {
    const [, left, right] = this.header.teams.findLast(([frame]) => frame <= place) ?? [0, '', ''];
    return [left || 'Left', right || 'Right'];
  }

  // The game's clock, between two rows as well.
  gameTime(place) {
    const [row, next, share] = this.between(place);
    return this.rows[row] + share * (this.rows[next] - this.rows[row]);
  }

  ball(place, position, orientation) {
    this.pose(place, 5, position, orientation);
  }

  slotColumn(slot) {
    return this.header.game + slot * this.header.robot;
  }

  // -1 if nobody is in this slot.
  robotType(place, slot) {
    return this.value(this.clampFrame(place), this.slotColumn(slot)) - 1;
  }

  torso(place, slot, position, orientation) {
    this.pose(place, this.slotColumn(slot) + 1, position, orientation);
  }

  joints(place, slot, angles) {
    const [row, next, share] = this.between(place);
    const column = this.slotColumn(slot) + 8;
    for (let i = 0; i < angles.length; ++i) {
      const from = this.rows[row + column + i];
      angles[i] = from + share * (this.rows[next + column + i] - from);
    }
  }

  // Offsets of the two rows around `place` and how far it is on the way.
  between(place) {
    const frame = this.clampFrame(place);
    const next = Math.min(frame + 1, this.frames - 1);
    return [frame * this.header.row, next * this.header.row, Math.max(0, Math.min(1, place - frame))];
  }

  pose(place, column, position, orientation) {
    const [row, next, share] = this.between(place);
    const a = row + column, b = next + column, r = this.rows;
    const far = Math.hypot(r[b] - r[a], r[b + 1] - r[a + 1]) > kJump * Math.max(this.step, 0.1) &&
      column !== 5 || Math.hypot(r[b] - r[a], r[b + 1] - r[a + 1]) > 3 * kJump * Math.max(this.step, 0.1);
    const s = far ? 0 : share;
    position.set(r[a] + s * (r[b] - r[a]), r[a + 1] + s * (r[b + 1] - r[a + 1]), r[a + 2] + s * (r[b + 2] - r[a + 2]));
    if (!orientation) return;
    orientation.set(r[a + 3], r[a + 4], r[a + 5], r[a + 6]);
    if (s > 0) orientation.slerp(kOther.set(r[b + 3], r[b + 4], r[b + 5], r[b + 6]), s);
  }
}

const kOther = new THREE.Quaternion();

export function slotName(slot) {
  return {side: slot < 11 ? 1 : 2, unum: slot % 11 + 1};
}
