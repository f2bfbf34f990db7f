// Regions as a picture of the whole pitch, which either view lays over the grass.

import type { Measures, Region, Shape } from "./messages";
import type { Painted } from "./view";
import { USUAL, extent } from "./view";

/** Pixels per metre of the usual pitch: of a small one there are more, so that it fills the picture. */
const PER_METRE = 8;
const WIDTH = 2 * USUAL.x * PER_METRE;
const HEIGHT = 2 * USUAL.y * PER_METRE;
const COLOURS = ["#56b4e9", "#e69f00", "#cc79a7", "#f0e442", "#009e73", "#d55e00"];
const LETTERS_MAX = 40;

/** Paints regions, each in a colour with its name; null without any. */
export function painted(regions: Region[], pitch: Measures): Painted | null {
  if (regions.length === 0) return null;
  const half = extent(pitch);
  const zoom = USUAL.x / half[0];
  const [all, layer] = sheet();
  regions.forEach((region, index) => {
    const colour = COLOURS[index % COLOURS.length] ?? "#ffffff";
    const inside = mask(region.shape, zoom);
    layer.globalAlpha = 0.3;
    layer.drawImage(tinted(inside, colour), 0, 0);
    layer.globalAlpha = 1;
    layer.drawImage(edge(inside, colour), 0, 0);
  });
  // Names have the same size in every picture.
  metres(layer, 1);
  layer.font = "600 1.8px system-ui, sans-serif";
  layer.textBaseline = "top";
  layer.lineWidth = 0.4;
  layer.strokeStyle = "#10181c";
  const taken: [number, number][] = [];
  regions.forEach((region, index) => {
    const name = region.name.length > LETTERS_MAX ? `${region.name.slice(0, LETTERS_MAX)}…` : region.name;
    const wide = layer.measureText(name).width;
    const [left, top] = corner(region.shape);
    const x = Math.min(left * zoom + 0.6, USUAL.x - wide - 0.5);
    let y = top * zoom + 0.6;
    // Names that begin at one place stand below each other.
    while (taken.some(([a, b]) => Math.abs(a - x) < 12 && Math.abs(b - y) < 2)) y += 2.2;
    taken.push([x, y]);
    layer.fillStyle = COLOURS[index % COLOURS.length] ?? "#ffffff";
    layer.strokeText(name, x, y);
    layer.fillText(name, x, y);
  });
  return { picture: all, half };
}

function sheet(): [HTMLCanvasElement, CanvasRenderingContext2D] {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [WIDTH, HEIGHT];
  const context = canvas.getContext("2d");
  if (!context) throw new Error("no canvas");
  return [canvas, context];
}

/** `zoom`: how much larger than on the usual pitch a metre is. */
function metres(context: CanvasRenderingContext2D, zoom: number): void {
  const scale = PER_METRE * zoom;
  context.setTransform(scale, 0, 0, scale, WIDTH / 2, HEIGHT / 2);
}

/** Opaque where the shape is. */
function mask(shape: Shape, zoom: number): HTMLCanvasElement {
  const [canvas, c] = sheet();
  const draw = (other: Shape, how: GlobalCompositeOperation) => {
    c.globalCompositeOperation = how;
    c.drawImage(mask(other, zoom), 0, 0);
  };
  if ("union" in shape) {
    draw(shape.union[0], "source-over");
    draw(shape.union[1], "source-over");
  } else if ("intersection" in shape) {
    draw(shape.intersection[0], "source-over");
    draw(shape.intersection[1], "destination-in");
  } else if ("difference" in shape) {
    draw(shape.difference[0], "source-over");
    draw(shape.difference[1], "destination-out");
  } else {
    metres(c, zoom);
    trace(c, shape);
    c.lineWidth = 0.25;
    c.fill();
    // A line has an area too, so that it is seen.
    c.stroke();
  }
  return canvas;
}

function trace(c: CanvasRenderingContext2D, shape: Shape): void {
  c.beginPath();
  if ("rect" in shape) {
    const [[x0, y0], [x1, y1]] = shape.rect;
    c.rect(Math.min(x0, x1), Math.min(y0, y1), Math.abs(x1 - x0), Math.abs(y1 - y0));
  } else if ("circle" in shape) {
    const [[x, y], radius] = shape.circle;
    c.arc(x, y, Math.max(0, radius), 0, 2 * Math.PI);
  } else if ("sector" in shape) {
    const { centre: [x, y], radius, from, width } = shape.sector;
    c.moveTo(x, y);
    c.arc(x, y, Math.max(0, radius), from, from + width);
    c.closePath();
  } else if ("polygon" in shape) {
    shape.polygon.forEach(([x, y], index) => (index === 0 ? c.moveTo(x, y) : c.lineTo(x, y)));
    c.closePath();
  }
}

function tinted(inside: HTMLCanvasElement, colour: string): HTMLCanvasElement {
  const [canvas, c] = sheet();
  c.drawImage(inside, 0, 0);
  c.globalCompositeOperation = "source-in";
  c.fillStyle = colour;
  c.fillRect(0, 0, WIDTH, HEIGHT);
  return canvas;
}

/** A line around a mask: the mask moved a little each way, less the mask. */
function edge(inside: HTMLCanvasElement, colour: string): HTMLCanvasElement {
  const [canvas, c] = sheet();
  for (const [x, y] of [[2, 0], [-2, 0], [0, 2], [0, -2]]) c.drawImage(inside, x ?? 0, y ?? 0);
  c.globalCompositeOperation = "destination-out";
  c.drawImage(inside, 0, 0);
  return tinted(canvas, colour);
}

/** The top left corner around a shape, where its name begins. */
function corner(shape: Shape): [number, number] {
  const least = (points: [number, number][]): [number, number] =>
    [Math.min(...points.map(([x]) => x)), Math.min(...points.map(([, y]) => y))];
  if ("rect" in shape) return least(shape.rect);
  if ("circle" in shape) {
    const [[x, y], radius] = shape.circle;
    return [x - radius, y - 1];
  }
  if ("sector" in shape) return shape.sector.centre;
  if ("polygon" in shape) return least(shape.polygon);
  if ("union" in shape) return corner(shape.union[0]);
  if ("intersection" in shape) {
    const [a, b] = shape.intersection.map(corner) as [[number, number], [number, number]];
    return [Math.max(a[0], b[0]), Math.max(a[1], b[1])];
  }
  return corner(shape.difference[0]);
}
