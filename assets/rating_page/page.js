"use strict";
// The page of one rater: what is asked stands in the element "page" as JSON. Answers are kept in this browser while
// they are given, and become a file when all are there. Nothing is sent.
(() => {
  const page = JSON.parse(document.getElementById("page").textContent);
  const by = (id) => document.getElementById(id);
  const [lowest, highest] = page.scale;
  const letter = (index) => String.fromCharCode(65 + index);
  const scenes = page.scenes;
  const last = scenes.length + 1; // steps: the start, the scenes, saving
  const asked = scenes.reduce((sum, scene) => sum + scene.pictures.length * page.criteria.length, 0);
  const place = `ramus rating sheet ${page.study} ${page.rater}`;

  // Made with text alone, never from HTML.
  function made(tag, attributes, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes || {}))
      if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
      else if (value !== null) element.setAttribute(name, value);
    element.append(...children);
    return element;
  }
  const counted = (number, one, many) => `${number} ${number === 1 ? one : many}`;

  const fresh = () => ({ scores: {}, role: "", years: "", started: null, seconds: {}, step: 0 });
  let state = fresh();
  let kept = true;  // whether the browser keeps what it is given
  let saved = true; // whether a file has all answers that were given

  function keep() {
    try {
      localStorage.setItem(place, JSON.stringify(state));
    } catch (error) {
      kept = false;
      by("not-kept").hidden = false;
    }
  }

  // What was kept may be of anybody: only what fits is taken.
  function recall() {
    let found = null;
    try {
      found = JSON.parse(localStorage.getItem(place));
    } catch (error) {
      return;
    }
    if (found === null || typeof found !== "object") return;
    for (const scene of scenes) {
      const seconds = Number((found.seconds || {})[scene.pictures[0].code]);
      if (seconds > 0) state.seconds[scene.pictures[0].code] = seconds;
      for (const picture of scene.pictures)
        for (const criterion of page.criteria) {
          const score = ((found.scores || {})[picture.code] || {})[criterion.key];
          if (Number.isInteger(score) && score >= lowest && score <= highest) give(picture, criterion, score);
        }
    }
    if (page.roles.some((role) => role.key === found.role)) state.role = found.role;
    if (typeof found.years === "string") state.years = found.years;
    if (typeof found.started === "string" && !isNaN(Date.parse(found.started))) state.started = found.started;
    if (Number.isInteger(found.step) && found.step >= 0 && found.step <= last) state.step = found.step;
  }

  function give(picture, criterion, score) {
    (state.scores[picture.code] = state.scores[picture.code] || {})[criterion.key] = score;
  }
  const score = (picture, criterion) => (state.scores[picture.code] || {})[criterion.key];

  function missing(scene) {
    const found = [];
    scene.pictures.forEach((picture, index) => {
      for (const criterion of page.criteria)
        if (score(picture, criterion) === undefined) found.push({ picture, index, criterion });
    });
    return found;
  }
  const allMissing = () => scenes.reduce((sum, scene) => sum + missing(scene).length, 0);

  // How long a scene was looked at: while it is shown and the page is in sight.
  let since = null;
  function clock() {
    const scene = scenes[state.step - 1];
    const now = performance.now();
    if (since !== null && scene) {
      const key = scene.pictures[0].code;
      state.seconds[key] = (state.seconds[key] || 0) + (now - since) / 1000;
    }
    since = scene && document.visibilityState === "visible" ? now : null;
  }

  const groupId = (picture, criterion) => `${picture.code}-${criterion.key}`;

  function scaleOf(picture, index, criterion) {
    const group = made("fieldset", { id: groupId(picture, criterion) });
    group.append(made("legend", { class: "unseen" }, `${criterion.name} of picture ${letter(index)}: ${criterion.question} ` +
      `${lowest} is ${criterion.low}, ${highest} is ${criterion.high}.`));
    const scale = made("div", { class: "scale" });
    for (let value = lowest; value <= highest; ++value) {
      const end = value === lowest ? `, ${criterion.low}` : value === highest ? `, ${criterion.high}` : "";
      const input = made("input", { type: "radio", name: group.id, value, "aria-label": value + end });
      input.checked = score(picture, criterion) === value;
      input.addEventListener("change", () => chosen(group, picture, criterion, value));
      scale.append(made("label", {}, input, made("span", { "aria-hidden": "true" }, String(value))));
    }
    group.append(scale, made("div", { class: "ends", "aria-hidden": "true" }, made("span", {}, criterion.low),
      made("span", {}, criterion.high)));
    group.addEventListener("keydown", (event) => {
      const value = Number(event.key);
      if (event.ctrlKey || event.altKey || event.metaKey || !(value >= lowest && value <= highest)) return;
      event.preventDefault();
      scale.querySelectorAll("input")[value - lowest].checked = true;
      chosen(group, picture, criterion, value);
      nextGroup(group);
    });
    return group;
  }

  function chosen(group, picture, criterion, value) {
    give(picture, criterion, value);
    group.classList.remove("missing");
    saved = false;
    keep();
    showProgress();
  }

  function focusGroup(group) {
    (group.querySelector("input:checked") || group.querySelector("input")).focus();
  }
  function nextGroup(group) {
    const groups = [...group.parentElement.querySelectorAll("fieldset")];
    const next = groups[groups.indexOf(group) + 1];
    if (next) focusGroup(next);
    else by("next").focus();
  }

  function sceneOf(scene, number) {
    const section = made("section", { class: "scene", id: `scene-${number}` });
    section.style.setProperty("--pictures", scene.pictures.length);
    section.append(made("p", { class: "corner quiet" }, "Click a picture to look closer."));
    scene.pictures.forEach((picture, index) => {
      section.append(made("button", { class: "picture", "aria-label": `Picture ${letter(index)}: look closer`,
        onclick: () => lookCloser(scene, index) },
        made("img", { src: picture.source, alt: "" }), made("b", {}, letter(index))));
    });
    for (const criterion of page.criteria) {
      section.append(made("div", { class: "rule" }), made("p", { class: "question", "aria-hidden": "true" },
        made("b", {}, criterion.name), made("span", {}, criterion.question)));
      scene.pictures.forEach((picture, index) => section.append(scaleOf(picture, index, criterion)));
    }
    return section;
  }

  // Pictures one upon the other, so that going to and fro shows what differs.
  let closer = null;
  function lookCloser(scene, index) {
    closer = { scene, index };
    by("closer-pictures").replaceChildren(...scene.pictures.map((picture, at) =>
      made("img", { src: picture.source, alt: `Picture ${letter(at)}` })));
    by("closer-choices").replaceChildren(...scene.pictures.map((picture, at) =>
      made("button", { onclick: () => turnTo(at), "aria-label": `Picture ${letter(at)}` }, letter(at))));
    turnTo(index);
    by("closer").showModal();
  }
  function turnTo(index) {
    closer.index = index;
    by("closer-name").textContent = `Picture ${letter(index)}`;
    [...by("closer-pictures").children].forEach((image, at) => image.classList.toggle("behind", at !== index));
    [...by("closer-choices").children].forEach((button, at) => button.setAttribute("aria-pressed", at === index));
  }

  const names = ["Start", ...scenes.map((scene, index) => `Scene ${index + 1}`), "Save"];
  function buildSteps() {
    by("steps").replaceChildren(...names.map((name, step) =>
      made("button", { onclick: () => go(step) }, step === 0 || step === last ? name : String(step))));
  }

  function showProgress() {
    const left = allMissing();
    by("progress").textContent = `${asked - left} of ${asked} answers`;
    [...by("steps").children].forEach((button, step) => {
      if (step === state.step) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
      if (step === 0 || step === last) return;
      const open = missing(scenes[step - 1]).length;
      button.textContent = open === 0 ? `${step} \u2713` : String(step);
      button.setAttribute("aria-label", `Scene ${step}: ` + (open === 0 ? "complete" : counted(open, "answer", "answers") + " missing"));
    });
    by("save-state").textContent = left === 0
      ? "All answers are there. Save them as a file, and hand it to whoever leads the study."
      : `${counted(left, "answer is", "answers are")} missing. They can be saved when all are there.`;
    by("as-text").hidden = left !== 0;
  }

  function go(step) {
    clock();
    state.step = step;
    if (step > 0 && state.started === null) state.started = new Date().toISOString();
    since = null;
    clock();
    [...by("parts").children].forEach((part, at) => (part.hidden = at !== step));
    const scene = scenes[step - 1];
    by("title").textContent = scene ? `Scene ${step} of ${scenes.length}: ${scene.title}` : step === 0 ? "Rating page" : "Save your answers";
    by("back").disabled = step === 0;
    by("next").disabled = step === last;
    by("next").textContent = step === 0 ? (asked === allMissing() ? "Begin" : "Go on") : "Next";
    by("save-result").replaceChildren();
    by("missing").replaceChildren();
    keep();
    showProgress();
    window.scrollTo(0, 0);
  }

  function years() { // null: no answer; undefined: one that cannot be
    const field = by("years");
    if (field.value === "") return field.validity.badInput ? undefined : null;
    const value = Number(field.value);
    return Number.isInteger(value) && value >= 0 && value <= page.most_years ? value : undefined;
  }
  function showYears() {
    by("years-wrong").textContent = years() === undefined ? `Give a whole number from 0 to ${page.most_years}, or nothing.` : "";
  }

  function answersText() {
    const answers = [];
    for (const scene of scenes)
      for (const picture of scene.pictures)
        for (const criterion of page.criteria)
          answers.push({ picture: picture.code, criterion: criterion.key, score: score(picture, criterion) });
    return JSON.stringify({
      format: page.format, version: page.version, study: page.study, rater: page.rater,
      role: state.role || null, years: years() === undefined ? null : years(),
      started: state.started, saved: new Date().toISOString(),
      scenes: scenes.map((scene) => ({
        order: scene.pictures.map((picture) => picture.code),
        seconds: Math.round(10 * (state.seconds[scene.pictures[0].code] || 0)) / 10,
      })),
      answers,
    }, null, 1) + "\n";
  }

  function listMissing() {
    by("missing").replaceChildren(...scenes.flatMap((scene, at) => {
      const open = missing(scene);
      if (open.length === 0) return [];
      return [made("h2", {}, `Scene ${at + 1}: ${scene.title}`), made("ul", {}, ...open.map((one) =>
        made("li", {}, made("button", {
          onclick: () => {
            go(at + 1);
            for (const other of open) by(groupId(other.picture, other.criterion)).classList.add("missing");
            focusGroup(by(groupId(one.picture, one.criterion)));
          },
        }, `Picture ${letter(one.index)}: ${one.criterion.name}`))))];
    }));
  }

  function save() {
    const left = allMissing();
    const wrongYears = years() === undefined;
    listMissing();
    if (left > 0 || wrongYears) {
      by("save-result").replaceChildren(made("p", { class: "notice" }, made("b", {}, "Not saved. "),
        left > 0 ? `${counted(left, "answer is", "answers are")} missing: choose one below to go there.`
                 : "The years of experience are no number: go to Start and correct them."));
      by("save-result").focus();
      return;
    }
    clock();
    by("as-text").open = false; // it would show what was before
    const file = `ratings_${page.study}_rater_${page.rater}.json`;
    const address = URL.createObjectURL(new Blob([answersText()], { type: "application/json" }));
    const link = made("a", { href: address, download: file });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(address), 60000);
    saved = true;
    keep();
    by("save-result").replaceChildren(made("p", { class: "notice" }, made("b", {}, "Saved "), `as ${file}, where this browser ` +
      "puts downloads. Hand this file to whoever leads the study. If you change an answer, save again and hand over the newer file."));
    by("save-result").focus();
  }

  recall();
  by("scene-count").textContent = counted(scenes.length, "scene", "scenes");
  by("questions").append(...page.criteria.map((criterion) => made("div", {}, made("dt", {}, criterion.name),
    made("dd", {}, `${criterion.question} `, made("span", { class: "quiet" }, `${lowest}: ${criterion.low}, ${highest}: ${criterion.high}`)))));
  by("role").append(...page.roles.map((role) => made("option", { value: role.key }, role.name)));
  by("role").value = state.role;
  by("role").addEventListener("change", () => { state.role = by("role").value; keep(); });
  by("years").max = page.most_years;
  by("years").value = state.years;
  by("years").addEventListener("input", () => { state.years = by("years").value; keep(); showYears(); });
  scenes.forEach((scene, index) => by("save").before(sceneOf(scene, index + 1)));
  buildSteps();
  by("back").addEventListener("click", () => { go(state.step - 1); by("title").focus(); });
  by("next").addEventListener("click", () => { go(state.step + 1); by("title").focus(); });
  by("save-answers").addEventListener("click", save);
  by("forget").addEventListener("click", () => {
    if (!window.confirm("Delete all answers of this page from this browser?")) return;
    try { localStorage.removeItem(place); } catch (error) { /* nothing was kept */ }
    saved = true;
    since = null;
    state = fresh();
    by("role").value = by("years").value = "";
    for (const input of document.querySelectorAll(".scale input")) input.checked = false;
    go(0);
  });
  by("as-text").firstElementChild.addEventListener("click", () => { by("text").value = answersText(); });
  by("closer").addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const count = closer.scene.pictures.length;
    if (step) turnTo((closer.index + step + count) % count);
  });
  by("closer-close").addEventListener("click", () => by("closer").close());
  document.addEventListener("visibilitychange", () => { clock(); keep(); });
  window.addEventListener("pagehide", () => { clock(); keep(); });
  window.addEventListener("beforeunload", (event) => { if (!kept && !saved) event.preventDefault(); });
  showYears();
  go(state.step);
})();
