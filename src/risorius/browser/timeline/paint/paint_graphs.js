import { handlesOf, traceKeys } from "../model/key_shapes.js";
/** @import {ChannelGraph, Detail, GraphRow, Key, Scale} from "../../types.js" */
/** @import {Model} from "../model/model.js" */
/** @import {Pyramid} from "../model/pyramid.js" */
/** @import {Scene} from "./scene.js" */

/**
 * The graph of a muscle: its final curve, each channel's own beneath, and shading where a channel is inhibited or limited.
 */

const PAD = 5;

/**
 * The scale of a graph: values to heights and back. Degrees are shown up to their maximum, at least 5.
 * @param {Model} model @param {GraphRow} row @returns {Scale}
 */
export function scaleOf(model, row) {
  const { low, high, signed, kind, neutral } = model.parameter(row.names[0]);
  const [top, bottom] = [row.y + PAD, row.y + row.height - PAD];
  let [least, most] = [low, high];
  if (signed || kind === "distance") {
    const reach = Math.max(signed ? 5 : 0.2, ...row.names.map((name) => reachOf(model, name, neutral)));
    [least, most] = [Math.max(low, neutral - reach), Math.min(high, neutral + reach)];
  }
  const scale = (bottom - top) / (most - least);
  return {
    least,
    most,
    neutral,
    y: (value) => bottom - (value - least) * scale,
    value: (y) => Math.max(low, Math.min(high, least + (bottom - y) / scale)),
  };
}

/** @param {Model} model @param {string} name @param {number} neutral */
function reachOf(model, name, neutral) {
  const curve = model.curve(name);
  if (!curve) return 0;
  const [least, most] = curve.range(0, curve.length);
  return 1.1 * Math.max(Math.abs(least - neutral), Math.abs(most - neutral));
}

/** @param {Scene} scene @param {GraphRow} row */
export function paintGraph(scene, row) {
  const { context, palette, model, details } = scene;
  const scale = scaleOf(model, row);
  context.fillStyle = palette.grid;
  context.fillRect(0, row.y + row.height - 1, scene.width, 1);
  context.fillRect(0, Math.round(scale.y(scale.neutral)), scene.width, 1);
  paintScale(scene, row, scale);
  const shown = row.names.find((name) => details.of(name)) ?? row.names[0];
  const detail = details.of(shown);
  if (detail) paintChannels(scene, row, scale, detail);
  const [main, ...others] = row.names;
  for (const name of others) if (model.differ(main, name)) paintCurve(scene, scale, name, palette.other, 1);
  paintCurve(scene, scale, main, palette.curve, 1.75);
  for (const name of row.names) paintKeys(scene, row, scale, name);
}

/** Label the top and the bottom of the graph. @param {Scene} scene @param {GraphRow} row @param {Scale} scale */
function paintScale({ context, palette, width, model }, row, { least, most }) {
  const { unit } = model.parameter(row.names[0]);
  const places = most - least > 4 ? 0 : most - least > 1 ? 1 : 0;
  context.fillStyle = palette.faint;
  context.font = `9px ${palette.font}`;
  context.textAlign = "right";
  context.textBaseline = "alphabetic";
  context.fillText(`${most.toFixed(places)}${unit ? ` ${unit}` : ""}`, width - 3, row.y + 11);
  context.fillText(least.toFixed(places), width - 3, row.y + row.height - 4);
}

/** @param {Scene} scene @param {Scale} scale @param {string} name @param {string} colour @param {number} width */
function paintCurve(scene, scale, name, colour, width) {
  const curve = scene.model.curve(name);
  scene.context.beginPath();
  if (curve) trace(scene, scale, curve, 0);
  else {
    scene.context.moveTo(scene.view.x(0), scale.y(scale.neutral));
    scene.context.lineTo(scene.view.x(scene.model.duration), scale.y(scale.neutral));
  }
  stroke(scene, colour, width);
}

/** @param {Scene} scene @param {string} colour @param {number} width */
function stroke({ context }, colour, width) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.lineJoin = "round";
  context.stroke();
}

/**
 * Draw the channels' curves: requested values as lines, actual ones filled; inhibited or limited parts are shaded.
 * @param {Scene} scene @param {GraphRow} row @param {Scale} scale @param {Detail} detail
 */
function paintChannels(scene, row, scale, { channels }) {
  for (const how of /** @type {("limited" | "inhibited")[]} */ (["limited", "inhibited"])) {
    const spans = channels.flatMap((channel) => channel[how]).sort((a, b) => a[0] - b[0]);
    shade(scene, row, spans, scene.palette[how]);
  }
  for (const channel of channels) {
    const colour = scene.palette.channels[channel.channel];
    fillGiven(scene, scale, channel, colour);
    scene.context.beginPath();
    trace(scene, scale, scene.model.pyramid(channel.asked), scale.neutral);
    scene.context.setLineDash([3, 2]);
    stroke(scene, colour, 1);
    scene.context.setLineDash([]);
  }
}

/** @param {Scene} scene @param {GraphRow} row @param {[number, number][]} spans @param {string} colour */
function shade({ context, view, count }, row, spans, colour) {
  context.fillStyle = colour;
  let painted = -Infinity;
  for (const [from, to] of spans.filter(([start, end]) => end >= view.start && start <= view.end)) {
    const [x, end] = [Math.max(view.x(from), painted), Math.max(view.x(to), view.x(from) + 1)];
    if (end <= x) continue;
    context.fillRect(x, row.y, end - x, row.height - 1);
    painted = end;
    count.marks++;
  }
}

/** @param {Scene} scene @param {Scale} scale @param {ChannelGraph} channel @param {string} colour */
function fillGiven(scene, scale, channel, colour) {
  const { context, view, model } = scene;
  const rest = scale.y(scale.neutral);
  context.beginPath();
  const [from, to] = trace(scene, scale, model.pyramid(channel.given), scale.neutral);
  context.lineTo(view.x(to), rest);
  context.lineTo(view.x(from), rest);
  context.fillStyle = colour;
  context.globalAlpha = 0.22;
  context.fill();
  context.globalAlpha = 1;
}

/**
 * Trace the visible part of a curve: frame by frame, or by minimum and maximum of each pixel.
 * @param {Scene} scene @param {Scale} scale @param {Pyramid} curve @param {number} neutral
 * @returns {[number, number]} the time of the first and the last point
 */
function trace({ context, view, model, count, width }, scale, curve, neutral) {
  const rate = model.take.rate;
  const first = Math.max(0, Math.floor(view.start * rate));
  const last = Math.min(curve.length - 1, Math.ceil(view.end * rate));
  if (rate / view.scale <= 2) {
    for (let k = first; k <= last; k++) context.lineTo(view.x(k / rate), scale.y(curve.values[k] + neutral));
    count.points += Math.max(last - first + 1, 0);
  } else {
    for (let x = Math.floor(Math.max(view.x(first / rate), 0)); x <= Math.min(view.x(last / rate), width); x++) {
      const from = view.time(x) * rate;
      const [least, most] = curve.range(Math.max(from, 0), Math.min(from + rate / view.scale, curve.length));
      context.lineTo(x, scale.y(least + neutral));
      context.lineTo(x, scale.y(most + neutral));
      count.points += 2;
    }
  }
  return [first / rate, last / rate];
}

/**
 * Draw the manual keys, the curve through them, and the handles of the selected key.
 * @param {Scene} scene @param {GraphRow} row @param {Scale} scale @param {string} name
 */
function paintKeys(scene, row, scale, name) {
  const { context, view, palette, selectedKey, count } = scene;
  const keys = scene.edits.keys(name);
  if (!keys?.length) return;
  context.beginPath();
  traceKeys(context, keys, (time) => view.x(time), (value) => scale.y(value));
  stroke(scene, palette.key, 1.5);
  if (selectedKey?.parameter === name && keys[selectedKey.index]) paintHandles(scene, scale, keys[selectedKey.index]);
  keys.forEach(([time, value], k) => {
    const x = view.x(time);
    if (x < -8 || x > view.width + 8) return;
    const chosen = selectedKey?.parameter === name && selectedKey.index === k;
    diamond(context, x, scale.y(value), chosen ? 5.5 : 4);
    context.fillStyle = chosen ? palette.mark : palette.key;
    context.fill();
    count.marks++;
  });
}

/** @param {Scene} scene @param {Scale} scale @param {Key} key */
function paintHandles({ context, view, palette, count }, scale, key) {
  const [x, y] = [view.x(key[0]), scale.y(key[1])];
  for (const handle of handlesOf(key)) {
    const [far, high] = [view.x(handle.time), scale.y(handle.value)];
    context.strokeStyle = palette.mark;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(far, high);
    context.stroke();
    context.beginPath();
    context.arc(far, high, 3.5, 0, 2 * Math.PI);
    context.fillStyle = palette.mark;
    context.fill();
    count.marks++;
  }
}

/** @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {number} size */
function diamond(context, x, y, size) {
  context.beginPath();
  context.moveTo(x, y - size);
  context.lineTo(x + size, y);
  context.lineTo(x, y + size);
  context.lineTo(x - size, y);
  context.closePath();
}
