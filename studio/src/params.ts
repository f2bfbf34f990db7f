// The parameters, each as a slider, a choice or a switch.

import type { Param } from "./messages";

/** The nearest of 1, 2, 5, 10, 20, … times a power of ten. */
function round(step: number): number {
  const power = 10 ** Math.floor(Math.log10(step));
  const times = [1, 2, 5, 10].find((times) => times * power >= step * 0.999) ?? 10;
  return Number((times * power).toPrecision(1));
}

export class Params {
  private readonly values = new Map<string, number>();
  private shape = "";

  constructor(
    private readonly parent: HTMLElement,
    private readonly bind: (params: Record<string, number>) => void,
  ) {}

  show(params: Param[]): void {
    const shape = JSON.stringify(params.map(({ name, range, choices, values, kind }) =>
      [name, range, choices, values, kind]));
    if (shape !== this.shape) {
      this.shape = shape;
      this.values.clear();
      this.parent.replaceChildren(...params.map((param) => this.row(param)));
    }
    for (const param of params) {
      const shown = this.parent.querySelector(`[data-shown="${CSS.escape(param.name)}"]`);
      if (shown) shown.textContent = param.shown;
    }
  }

  private row(param: Param): HTMLElement {
    const row = document.createElement("label");
    row.className = "param";
    row.title = param.doc;
    const name = document.createElement("span");
    name.textContent = param.name;
    const shown = document.createElement("output");
    shown.dataset["shown"] = param.name;
    row.append(name, this.control(param), shown);
    return row;
  }

  private control(param: Param): HTMLElement {
    const set = (value: number) => {
      this.values.set(param.name, value);
      this.bind(Object.fromEntries(this.values));
    };
    if (param.choices.length > 0 || param.values.length > 0) {
      const select = document.createElement("select");
      const options = param.choices.length > 0
        ? param.choices.map((word, index): [string, number] => [word, index])
        : param.values.map((value): [string, number] => [String(value), value]);
      for (const [word, value] of options) {
        select.add(new Option(word, String(value), false, value === param.value));
      }
      select.onchange = () => set(Number(select.value));
      return select;
    }
    const input = document.createElement("input");
    if (param.kind === "bool") {
      input.type = "checkbox";
      input.checked = param.value !== 0;
      input.onchange = () => set(input.checked ? 1 : 0);
      return input;
    }
    if (!param.range) {
      input.type = "number";
      input.value = String(param.value);
      input.onchange = () => set(Number(input.value));
      return input;
    }
    const [low, high] = param.range;
    input.type = "range";
    [input.min, input.max] = [String(low), String(high)];
    input.step = param.kind === "integer" ? "1" : String(round((high - low) / 200));
    input.value = String(param.value);
    input.oninput = () => set(Number(input.value));
    return input;
  }
}
