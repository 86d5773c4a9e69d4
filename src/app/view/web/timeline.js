// The bar at the bottom: what happened when, and where the player stands. Click or drag to seek.
import {kTeamColors} from './stage.js';

const kLanes = ['goal', 'kick', 'fall', 'foul'];
const kNames = {goal: 'Goals', kick: 'Kicks', fall: 'Falls', foul: 'Fouls'};
const kLeft = 46;   // pixels for the names of the lanes
const kRight = 10;

export class Timeline {
  constructor(canvas, tip, track, seek) {
    this.canvas = canvas;
    this.tip = tip;
    this.track = track;
    this.seek = seek;
    this.drawn = '';
    canvas.addEventListener('pointerdown', event => {
      canvas.setPointerCapture(event.pointerId);
      this.dragging = true;
      seek(this.placeAt(event.offsetX));
    });
    canvas.addEventListener('pointermove', event => {
      if (this.dragging) seek(this.placeAt(event.offsetX));
      this.showTip(event.offsetX, event.offsetY);
    });
    canvas.addEventListener('pointerup', () => { this.dragging = false; });
    canvas.addEventListener('pointerleave', () => { this.tip.hidden = true; });
  }

  get last() { return Math.max(1, this.track.frames - 1); }
  xOf(place) { return kLeft + (this.canvas.clientWidth - kLeft - kRight) * place / this.last; }
  placeAt(x) {
    const share = (x - kLeft) / (this.canvas.clientWidth - kLeft - kRight);
    return Math.max(0, Math.min(1, share)) * this.last;
  }
  laneY(lane) { return 9 + 14.5 * lane; }

  draw(place) {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    const ratio = window.devicePixelRatio || 1;
    const state = [width, height, this.track.frames, this.track.events.length, Math.round(this.xOf(place) * 2)].join();
    if (state === this.drawn) return;
    this.drawn = state;
    this.canvas.width = width * ratio;
    this.canvas.height = height * ratio;
    const pen = this.canvas.getContext('2d');
    pen.scale(ratio, ratio);
    this.drawLanes(pen, width);
    for (const event of this.track.events) this.drawEvent(pen, event);
    this.drawTimes(pen, width, height);
    pen.fillStyle = '#ffffff';
    pen.fillRect(this.xOf(place) - 1, 0, 2, 62);
    pen.beginPath();
    pen.arc(this.xOf(place), 62, 5, 0, 7);
    pen.fill();
  }

  // Bright while the game is on, dark while it is interrupted.
  drawLanes(pen, width) {
    const modes = this.track.events.filter(event => event.kind === 'mode');
    modes.forEach((event, i) => {
      const end = i + 1 < modes.length ? modes[i + 1].frame : this.last;
      pen.fillStyle = event.text === 'PlayOn' ? 'rgba(120,200,140,0.20)' : 'rgba(255,255,255,0.05)';
      pen.fillRect(this.xOf(event.frame), 0, this.xOf(end) - this.xOf(event.frame), 60);
    });
    pen.font = '11px system-ui, "DejaVu Sans", sans-serif';
    pen.textAlign = 'right';
    pen.textBaseline = 'middle';
    kLanes.forEach((kind, lane) => {
      pen.fillStyle = '#93a1b1';
      pen.fillText(kNames[kind], kLeft - 7, this.laneY(lane));
      pen.fillStyle = 'rgba(255,255,255,0.07)';
      pen.fillRect(kLeft, this.laneY(lane), width - kLeft - kRight, 1);
    });
  }

  drawEvent(pen, event) {
    const lane = kLanes.indexOf(event.kind);
    if (lane < 0) return;
    const x = this.xOf(event.frame), y = this.laneY(lane);
    pen.fillStyle = event.side > 0 ? kTeamColors[event.side - 1] : '#cccccc';
    pen.beginPath();
    if (event.kind === 'goal') {
      pen.arc(x, y, 6, 0, 7);
      pen.strokeStyle = '#ffffff';
      pen.lineWidth = 1.5;
      pen.fill();
      pen.stroke();
      return;
    }
    if (event.kind === 'kick') {
      pen.rect(x - 1, y - 5, 2, 10);
    } else if (event.kind === 'fall') {
      pen.moveTo(x - 4, y - 4);
      pen.lineTo(x + 4, y - 4);
      pen.lineTo(x, y + 4);
    } else {
      pen.moveTo(x, y - 5);
      pen.lineTo(x + 4.5, y);
      pen.lineTo(x, y + 5);
      pen.lineTo(x - 4.5, y);
    }
    pen.fill();
  }

  drawTimes(pen, width, height) {
    const seconds = this.last * this.track.step;
    const room = Math.max(1, (width - kLeft) / 80);
    const step = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600].find(s => seconds / s <= room) || 1200;
    pen.fillStyle = '#93a1b1';
    pen.textAlign = 'center';
    for (let t = 0; t <= seconds; t += step) {
      const x = this.xOf(t / this.track.step);
      pen.fillRect(x, 58, 1, 4);
      if (x < width - 22) pen.fillText(clockText(t), Math.max(x, kLeft + 10), height - 6);
    }
  }

  showTip(x, y) {
    let best = null, nearest = 7;
    for (const event of this.track.events) {
      const lane = kLanes.indexOf(event.kind);
      if (lane < 0) continue;
      const distance = Math.hypot(this.xOf(event.frame) - x, this.laneY(lane) - y);
      if (distance < nearest) [best, nearest] = [event, distance];
    }
    this.tip.hidden = false;
    this.tip.style.left = `${Math.max(90, Math.min(this.canvas.clientWidth - 90, x)) + 12}px`;
    this.tip.textContent = best ? eventText(best, this.track) : clockText(this.placeAt(x) * this.track.step);
  }
}

export function clockText(seconds) {
  const whole = Math.floor(Math.max(0, seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}

function eventText(event, track) {
  const team = event.side > 0 ? track.teams(event.frame)[event.side - 1] : '';
  const who = event.unum > 0 ? `${team} ${event.unum}` : team;
  const what = {goal: 'goal', kick: `kick, ball at ${event.text}`, fall: 'falls', foul: event.text}[event.kind];
  return `${clockText(event.frame * track.step)}  ${who}: ${what}`;
}
