// Before uPlot, which formats numbers in the language of the browser when it is loaded. Some browsers name a language that is
// none, as en-US@posix without a locale of the system; the plots are then drawn with numbers in English.
"use strict";
try {
  new Intl.NumberFormat(navigator.language);
} catch {
  Object.defineProperty(navigator, "language", { value: "en", configurable: true });
}
