// Draws the plots of a page from the data in it. Nothing is fetched.
"use strict";
(() => {
  const explain = (message) => {
    const place = document.getElementById("script-error");
    if (!place) return;
    place.hidden = false;
    place.className = "error";
    place.textContent = "The plots could not be drawn: " + message;
  };
  addEventListener("error", (event) => explain(event.message));

  // Okabe and Ito: colour-blind readers can distinguish these.
  const ON_LIGHT = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8a7f00", "#7f7f7f"];
  // The same hues, light enough for a dark page.
  const ON_DARK = ["#4aa3e0", "#f0b429", "#2bbf93", "#e29fc6", "#8fd0f7", "#ff8a4c", "#c9bd3a", "#a9a9a9"];
  const colors = () => (matchMedia("(prefers-color-scheme: dark)").matches && !document.documentElement.classList.contains("on-paper") ? ON_DARK : ON_LIGHT);
  // An error below any rounding error has a place on a logarithmic axis.
  const FLOOR = 1e-18;
  // Where a logarithmic axis begins: a thousandth of the limit, below which there is only rounding.
  const floor = (chart) => {
    const limits = chart.limits.map((limit) => limit.value).filter((limit) => limit > 0);
    return limits.length > 0 ? 1e-3 * Math.min(...limits) : FLOOR;
  };
  // A limit widens a plot up to this many times.
  const WIDEST = 3;

  const data = JSON.parse(document.getElementById("plots").textContent);
  const floats = (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new Float32Array(bytes.buffer);
  };
  const times = floats(data.times_s);
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  const digits = (value) => {
    if (value === 0) return "0";
    const size = Math.abs(value);
    return size < 1e-4 || size >= 1e7 ? value.toExponential(1).replace(".0e", "e") : String(Number(value.toPrecision(3)));
  };
  // Each line on the times of all lines of its chart.
  const aligned = (chart) => {
    const lines = chart.lines.map((line) => {
      const values = floats(line.values);
      const shown = Array.from(values, (value) => {
        if (!Number.isFinite(value)) return null;
        return (chart.log ? Math.max(value, floor(chart)) : value) * chart.scale;
      });
      return { x: Array.from(line.times_s ? floats(line.times_s) : times), shown };
    });
    const same = lines.every((line) => line.x.length === lines[0].x.length && line.x[1] === lines[0].x[1]);
    if (same) return [lines[0].x, ...lines.map((line) => line.shown)];
    return uPlot.join(lines.map((line) => [line.x, line.shown]));
  };

  // What the vertical axis spans: all that is shown, and limits that are near or that the chart is about.
  const spanned = (chart, low, high) => {
    if (!Number.isFinite(low) || !Number.isFinite(high)) return chart.log ? [1e-16, 1] : [-1, 1];
    const limits = chart.limits.map((limit) => limit.value * chart.scale);
    if (chart.log) {
      const all = limits.filter((limit) => limit > 0).concat(low, high);
      return [10 ** Math.floor(Math.log10(Math.min(...all))), 10 ** Math.ceil(Math.log10(Math.max(...all) * 1.01))];
    }
    const span = Math.max(high - low, Math.abs(high) * 0.03, 1e-9);
    const beyond = (limit) => Math.max(low - limit, limit - high, 0);
    for (const limit of limits.sort((a, b) => beyond(a) - beyond(b))) {
      const [lower, upper] = [Math.min(low, limit), Math.max(high, limit)];
      if (chart.has_all_limits || upper - lower <= WIDEST * span) [low, high] = [lower, upper];
    }
    const free = Math.max(0.1 * (high - low), 0.5 * (span - (high - low)));
    return [low - free, high + free];
  };

  // So many decimals that ticks of this distance are told apart.
  const decimals = (distance) => {
    const isWhole = (count) => Math.abs(distance * 10 ** count - Math.round(distance * 10 ** count)) < 1e-6;
    const enough = [0, 1, 2, 3, 4, 5, 6].find((count) => distance * 10 ** count >= 1 && isWhole(count));
    return (tick) => (enough === undefined ? digits(tick) : tick.toFixed(enough));
  };

  // At most seven powers of ten.
  const decades = (low, high) => {
    const [first, last] = [low, high].map((value) => Math.round(Math.log10(value)));
    const step = Math.max(1, Math.ceil((last - first) / 6));
    return Array.from({ length: Math.floor((last - first) / step) + 1 }, (_, index) => 10 ** (first + index * step));
  };

  // Writes words where no others are: at the first free of some places, on the colour of the page.
  const writer = (ctx, ratio) => {
    const taken = [];
    return (text, places, color) => {
      const [width, height] = [ctx.measureText(text).width + 6 * ratio, 14 * ratio];
      const boxes = places.map(([x, y, side]) => [side === "right" ? x - width : x, y - height, width, height]);
      const meets = (a, b) => a[0] < b[0] + b[2] && b[0] < a[0] + a[2] && a[1] < b[1] + b[3] && b[1] < a[1] + a[3];
      const { x, y, w, h } = writer.inside;
      const fits = (box) => box[0] >= x - 1 && box[1] >= y - 1 && box[0] + box[2] <= x + w + 1 && box[1] + box[3] <= y + h + 1;
      const box = boxes.find((box) => fits(box) && !taken.some((other) => meets(box, other)));
      if (!box) return;
      taken.push(box);
      ctx.globalAlpha = 0.82;
      ctx.fillStyle = css("--paper");
      ctx.fillRect(...box);
      ctx.globalAlpha = 1;
      ctx.fillStyle = color;
      ctx.textAlign = "left";
      ctx.fillText(text, box[0] + 3 * ratio, box[1] + 11 * ratio);
    };
  };

  const MARKS = { violation: "--bad", stop: "--bad", fault: "--unclear", event: "--faint", motion: "--grid" };

  // Limits across, instants down, and the points that are named.
  const annotate = (chart, small) => (plot) => {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    const ratio = devicePixelRatio || 1;
    const [right, bottom] = [bbox.left + bbox.width, bbox.top + bbox.height];
    const line = (x0, y0, x1, y1, color, width, dash) => {
      ctx.strokeStyle = color;
      ctx.lineWidth = width * ratio;
      ctx.setLineDash(dash.map((length) => length * ratio));
      ctx.beginPath();
      ctx.moveTo(x0, y0);
      ctx.lineTo(x1, y1);
      ctx.stroke();
    };
    ctx.font = 11 * ratio + "px system-ui, sans-serif";
    ctx.textBaseline = "alphabetic";
    writer.inside = { x: bbox.left, y: bbox.top, w: bbox.width, h: bbox.height };
    const write = writer(ctx, ratio);
    const across = chart.limits.map((limit) => [limit, plot.valToPos(limit.value * chart.scale, "y", true)]);
    for (const [, y] of across) line(bbox.left, y, right, y, css("--bad"), 1.5, [7, 4]);
    const down = data.marks.map((mark) => [mark, Math.round(plot.valToPos(mark.time_s, "x", true))]);
    for (const [mark, x] of down) line(x, bbox.top, x, bottom, css(MARKS[mark.kind]), mark.kind === "motion" ? 1 : 1.25, mark.kind === "motion" ? [] : [4, 3]);
    // The point of the chart first: it has its place before others.
    for (const point of chart.points || []) {
      const [x, y] = [plot.valToPos(point.time_s, "x", true), plot.valToPos(point.value * chart.scale, "y", true)];
      ctx.fillStyle = css("--bad");
      ctx.strokeStyle = css("--paper");
      ctx.setLineDash([]);
      ctx.lineWidth = 2 * ratio;
      ctx.beginPath();
      ctx.arc(x, y, 5 * ratio, 0, 2 * Math.PI);
      ctx.fill();
      ctx.stroke();
      const [near, far] = [x + 9 * ratio, x - 9 * ratio];
      const heights = [-5, 20, -22, 37, 60, -45].map((away) => y + away * ratio);
      write(point.text, heights.flatMap((height) => [[near, height, "left"], [far, height, "right"]]), css("--bad"));
    }
    // Of several limits at one height, one name.
    for (const [limit, y] of across) {
      if (y < bbox.top - 1 || y > bottom + 1) {
        const edge = y < bbox.top ? bbox.top + 15 * ratio : bottom - 2 * ratio;
        if (limit.name) write(limit.name + (y < bbox.top ? ", above" : ", below"), [[right - 2 * ratio, edge, "right"], [bbox.left + 4 * ratio, edge, "left"]], css("--faint"));
        continue;
      }
      if (!limit.name) continue;
      const heights = [y - 2 * ratio, y + 15 * ratio];
      write(limit.name, heights.flatMap((height) => [[right - 2 * ratio, height, "right"], [bbox.left + 4 * ratio, height, "left"]]), css("--bad"));
    }
    if (!small) {
      for (const [mark, x] of down.filter(([mark]) => mark.text)) {
        const rows = [3, 18, 33, 48].map((away) => bottom - away * ratio);
        write(mark.text, rows.flatMap((row) => [[x + 3 * ratio, row, "left"], [x - 3 * ratio, row, "right"]]), css(MARKS[mark.kind] === "--grid" ? "--faint" : MARKS[mark.kind]));
      }
    }
    ctx.restore();
  };

  const built = [];
  const build = (place, chart) => {
    const small = place.closest(".plots") !== null;
    const palette = colors();
    const ink = css("--ink"), grid = css("--grid");
    const shown = (value) => digits(value) + " " + chart.unit;
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 }, font: "11px system-ui, sans-serif" };
    const series = chart.lines.map((line, index) => ({
      label: line.name,
      show: !line.hidden,
      stroke: palette[index % palette.length],
      width: line.dashed ? 1.25 : 1.6,
      dash: line.dashed ? [6, 4] : index >= palette.length ? [2, 3] : undefined,
      spanGaps: true,
      points: { show: false },
      value: (plot, value, _, at) => {
        if (value == null) return "";
        const subject = line.subjects ? line.subject_names[line.subjects[at]] : undefined;
        return shown(value) + (subject ? " " + subject : "");
      },
    }));
    const options = {
      width: place.clientWidth,
      height: small ? 150 : place.closest(".first") ? 340 : 240,
      cursor: { sync: { key: "run" }, y: false, drag: { x: true, y: false } },
      // A single line is what the caption says.
      legend: { show: series.length > 1 || chart.lines.some((line) => line.subjects), live: true },
      scales: {
        x: { time: false },
        y: { distr: chart.log ? 3 : 1, range: (plot, low, high) => spanned(chart, low, high) },
      },
      axes: [
        { ...axis, size: small ? 28 : 34, values: (plot, ticks) => ticks.map((tick) => digits(tick) + " s") },
        {
          ...axis,
          size: chart.log ? 66 : 58,
          space: small ? 18 : 30,
          filter: (plot, ticks) => ticks,
          splits: chart.log ? (plot, _, low, high) => decades(low, high) : undefined,
          values: (plot, ticks, axis, space, distance) => {
            const written = chart.log ? digits : decimals(distance);
            return ticks.map((tick) => (tick == null ? "" : written(tick)));
          },
          label: chart.unit,
          labelSize: 16,
          labelFont: "11px system-ui, sans-serif",
          labelGap: 0,
        },
      ],
      series: [{ label: "time", value: (plot, value) => (value == null ? "" : digits(value) + " s") }, ...series],
      hooks: { draw: [annotate(chart, small)] },
    };
    const plot = new uPlot(options, aligned(chart), place);
    const legend = plot.root.querySelector(".u-legend");
    if (legend && chart.others) {
      const others = document.createElement("caption");
      others.textContent = chart.others === 1 ? "and 1 other, with smaller values" : "and " + chart.others + " others, with smaller values";
      legend.append(others);
    }
    return plot;
  };

  const draw = (figure) => {
    const chart = data.charts.find((chart) => chart.id === figure.dataset.chart);
    const place = figure.querySelector(".chart");
    if (!chart || place.clientWidth === 0 || built.some((known) => known.place === place)) return;
    built.push({ place, chart, plot: build(place, chart) });
  };
  const drawAll = () => document.querySelectorAll("figure[data-chart]").forEach(draw);
  const again = () => {
    for (const each of built) {
      each.plot.destroy();
      each.plot = build(each.place, each.chart);
    }
  };
  drawAll();
  document.querySelectorAll("details").forEach((details) => details.addEventListener("toggle", drawAll));
  addEventListener("resize", () => {
    for (const { place, plot } of built) {
      if (place.clientWidth > 0 && place.clientWidth !== plot.width) plot.setSize({ width: place.clientWidth, height: plot.height });
    }
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
  addEventListener("beforeprint", () => {
    document.documentElement.classList.add("on-paper");
    // Of what is folded, tables are printed; plots of everything else only if the reader has opened them.
    document.querySelectorAll("details:not(.part)").forEach((details) => (details.open = true));
    drawAll();
    again();
  });
  addEventListener("afterprint", () => {
    document.documentElement.classList.remove("on-paper");
    again();
  });
})();
