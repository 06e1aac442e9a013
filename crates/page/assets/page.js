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
  const COLORS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8a7f00", "#7f7f7f"];
  // An error below any rounding error has a place on a logarithmic axis.
  const FLOOR = 1e-18;
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
  // From a value on, the unit in which it is shown and how many there are of it.
  const DEGREES = 180 / Math.PI;
  const LENGTHS = [[10, "m", 1], [1e-4, "mm", 1e3], [1e-6, "um", 1e6], [1e-9, "nm", 1e9]];
  const ANGLES = [[1e-3 / DEGREES, "deg", DEGREES], [1e-6, "urad", 1e6], [1e-9, "nrad", 1e9]];
  // Powers of ten are round in radians alone.
  const STEPS = { m: LENGTHS, rad: ANGLES, "rad on an axis": [[1e-4, "rad", 1], ...ANGLES.slice(1)] };
  const withUnit = (value, unit, place = "") => {
    const step = STEPS[unit + place].find(([from]) => Math.abs(value) >= from * 0.9995);
    return step ? digits(value * step[2]) + " " + step[1] : digits(value) + " " + unit;
  };

  // Each line on the times of all lines of its chart.
  const aligned = (chart) => {
    const lines = chart.lines.map((line) => {
      const values = floats(line.values);
      const shown = Array.from(values, (value) => {
        if (!Number.isFinite(value)) return null;
        return chart.log ? Math.max(value, FLOOR) : value * chart.scale;
      });
      return { x: Array.from(line.times_s ? floats(line.times_s) : times), shown };
    });
    const same = lines.every((line) => line.x.length === lines[0].x.length && line.x[1] === lines[0].x[1]);
    if (same) return [lines[0].x, ...lines.map((line) => line.shown)];
    return uPlot.join(lines.map((line) => [line.x, line.shown]));
  };

  // What the vertical axis spans: all that is shown, and limits that are near.
  const spanned = (chart, low, high) => {
    if (!Number.isFinite(low) || !Number.isFinite(high)) return chart.log ? [1e-16, 1] : [-1, 1];
    const limits = chart.limits.map((limit) => limit.value * (chart.log ? 1 : chart.scale));
    if (chart.log) {
      const all = limits.filter((limit) => limit > 0).concat(low, high);
      return [10 ** Math.floor(Math.log10(Math.min(...all))), 10 ** Math.ceil(Math.log10(Math.max(...all) * 1.01))];
    }
    const span = Math.max(high - low, Math.abs(high) * 0.03, 1e-9);
    const beyond = (limit) => Math.max(low - limit, limit - high, 0);
    for (const limit of limits.sort((a, b) => beyond(a) - beyond(b))) {
      const [lower, upper] = [Math.min(low, limit), Math.max(high, limit)];
      if (upper - lower <= WIDEST * span) [low, high] = [lower, upper];
    }
    const free = Math.max(0.06 * (high - low), 0.5 * (span - (high - low)));
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

  // Limits across, and instants down.
  const annotate = (chart, small) => (plot) => {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    const ratio = devicePixelRatio || 1;
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
    // Where the words in each row end: words that would meet are below each other.
    const rows = [];
    const free = (from) => {
      const row = rows.findIndex((end) => end < from);
      return row < 0 ? rows.length : row;
    };
    for (const mark of data.marks) {
      const x = Math.round(plot.valToPos(mark.time_s, "x", true));
      const strong = mark.kind !== "motion";
      line(x, bbox.top, x, bbox.top + bbox.height, css(strong ? "--bad" : "--grid"), strong ? 1.5 : 1, strong ? [4, 3] : []);
      if (strong && !small) {
        const left = x > bbox.left + bbox.width - 90 * ratio;
        ctx.fillStyle = css("--bad");
        ctx.textAlign = left ? "right" : "left";
        const length = ctx.measureText(mark.text).width + 10 * ratio;
        const from = left ? x - length : x;
        const row = free(from);
        rows[row] = from + length;
        ctx.fillText(mark.text, x + (left ? -5 : 5) * ratio, bbox.top + (12 + 13 * row) * ratio);
      }
    }
    for (const limit of chart.limits) {
      const y = plot.valToPos(limit.value * (chart.log ? 1 : chart.scale), "y", true);
      line(bbox.left, y, bbox.left + bbox.width, y, css("--bad"), 1.5, [7, 4]);
      ctx.fillStyle = css("--bad");
      ctx.textAlign = "right";
      if (y >= bbox.top - 1 && y <= bbox.top + bbox.height + 1) {
        const above = y - bbox.top > 16 * ratio;
        ctx.fillText(limit.name, bbox.left + bbox.width - 4 * ratio, y + (above ? -4 : 13) * ratio);
      }
    }
    ctx.restore();
  };

  const built = [];
  const build = (place, chart) => {
    const small = place.closest(".plots") !== null;
    const ink = css("--ink"), grid = css("--grid");
    const shown = (value) => (chart.log ? withUnit(value, chart.unit) : digits(value) + " " + chart.unit);
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 }, font: "11px system-ui, sans-serif" };
    const series = chart.lines.map((line, index) => ({
      label: line.name,
      show: !line.hidden,
      stroke: COLORS[index % COLORS.length],
      width: line.dashed ? 1.25 : 1.6,
      dash: line.dashed ? [6, 4] : index >= COLORS.length ? [2, 3] : undefined,
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
      height: small ? 150 : 260,
      cursor: { sync: { key: "run" }, y: false, drag: { x: true, y: false } },
      legend: { show: true, live: true },
      scales: {
        x: { time: false },
        y: { distr: chart.log ? 3 : 1, range: (plot, low, high) => spanned(chart, low, high) },
      },
      axes: [
        { ...axis, size: small ? 28 : 34, values: (plot, ticks) => ticks.map((tick) => digits(tick) + " s") },
        {
          ...axis,
          size: chart.log ? 82 : 58,
          space: small ? 18 : 30,
          filter: (plot, ticks) => ticks,
          splits: chart.log ? (plot, _, low, high) => decades(low, high) : undefined,
          values: (plot, ticks, axis, space, distance) => {
            const onLog = (tick) => withUnit(tick, chart.unit, chart.unit === "rad" ? " on an axis" : "");
            const written = chart.log ? onLog : decimals(distance);
            return ticks.map((tick) => (tick == null ? "" : written(tick)));
          },
          label: chart.log ? undefined : chart.unit,
          labelSize: 16,
          labelFont: "11px system-ui, sans-serif",
          labelGap: 0,
        },
      ],
      series: [{ label: "time", value: (plot, value) => (value == null ? "" : digits(value) + " s") }, ...series],
      hooks: { draw: [annotate(chart, small)] },
    };
    return new uPlot(options, aligned(chart), place);
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
    document.querySelectorAll("details").forEach((details) => (details.open = true));
    drawAll();
    again();
  });
  addEventListener("afterprint", () => {
    document.documentElement.classList.remove("on-paper");
    again();
  });
})();
