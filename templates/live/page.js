// The page beside the editor: shows each view that the server tells of, and keeps the reader's place in it.
"use strict";

const part = (id) => document.getElementById(id);
const views = new EventSource("views");
let view = null; // the one that is shown
let frame = null; // in which the last good page stands
let shown = 0; // which page that is

const made = (tag, text, of = {}) => Object.assign(document.createElement(tag), { textContent: text }, of);
const plural = (count, word) => `${count} ${word}${count === 1 ? "" : "s"}`;

views.onmessage = (event) => {
  view = JSON.parse(event.data);
  tell();
  if (view.building) return;
  list(part("faults"), view.faults);
  list(part("warnings"), view.warnings);
  write();
  prove();
  part("frames").classList.toggle("old", view.faults.length > 0 && view.pages > 0);
  if (view.pages !== shown) turn(view.pages);
  else mark();
};

views.onerror = () => {
  part("state").textContent = "derive has ended; this is what it showed last";
  document.title = `ended: ${view ? view.name : "derive"}`;
};

/* What the bar and the tab say. */
function tell() {
  const faults = view.faults.length;
  const since = view.pages ? `; the page is of ${view.made}` : "";
  const state = view.building ? "building ..." : faults ? plural(faults, "fault") + since : `${view.made}, ${view.seconds} s`;
  part("state").textContent = `${view.name}: ${state}`;
  part("state").classList.toggle("wrong", !view.building && faults > 0);
  document.title = faults ? `${plural(faults, "fault")}: ${view.name}` : view.name;
  part("steps").value = view.steps || "";
}

/* Faults or warnings as the terminal has them; those in the sheet lead to their line. */
function list(box, all) {
  box.hidden = all.length === 0;
  box.replaceChildren(...all.map((each) => {
    const line = made(each.line ? "button" : "div", "", { className: "said" });
    line.append(made("pre", each.text));
    if (each.line) line.onclick = () => toLines(each.line, each.line);
    return line;
  }));
}

/* The sheet, its faults in place. */
function write() {
  part("source").firstElementChild.replaceChildren(...view.source.map((text, index) => {
    const number = index + 1;
    const line = made("li", "");
    const button = made("button", number, { title: "show this in the page" });
    button.onclick = () => toSection(number);
    const code = made("code", text);
    line.append(button, code);
    for (const fault of view.faults.filter((each) => each.line === number)) {
      line.className = "wrong";
      code.replaceChildren(text.slice(0, fault.column - 1), made("mark", text.slice(fault.column - 1) || " "));
      line.append(made("p", fault.hint ? `${fault.message} (hint: ${fault.hint})` : fault.message));
    }
    return line;
  }));
}

/* What was proved, a paragraph a line of the terminal, which is wrapped there. */
function prove() {
  const lines = view.proved.join("\n").replace(/\n {4}/g, " ").split("\n");
  part("proved").replaceChildren(...lines.map((line) => made(line.startsWith(" ") ? "p" : "h2", line)));
}

/* -- the page, turned without a flash and without losing the reader's place ---------------------------- */

function turn(pages) {
  shown = pages;
  const next = made("iframe", "", { className: "next", src: `sheet?${pages}`, title: "The page" });
  next.onload = () => {
    if (pages !== shown) return next.remove();
    if (frame) goTo(next.contentWindow, placeIn(frame.contentWindow));
    next.className = "";
    if (frame) frame.remove();
    frame = next;
    frame.contentDocument.addEventListener("click", clicked);
    mark();
  };
  part("frames").append(next);
}

const headings = (page) => [...page.querySelectorAll("h2[id], h3[id]")];

/* Where a reader is: so far below the heading above what is read, which stays there. */
function placeIn(page) {
  const above = headings(page.document).filter((each) => each.getBoundingClientRect().top <= 1).pop();
  return { id: above && above.id, top: above ? above.getBoundingClientRect().top : 0, x: page.scrollX, y: page.scrollY };
}

function goTo(page, place) {
  const same = place.id && page.document.getElementById(place.id);
  page.scrollTo(place.x, same ? page.scrollY + same.getBoundingClientRect().top - place.top : place.y);
}

/* Headings of problems and questions in which a fault stands now. */
function mark() {
  if (!frame || !frame.contentDocument) return;
  const wrong = new Set(view.faults.map((fault) => sectionOf(fault.line)).filter(Boolean).map((each) => each.id));
  for (const heading of headings(frame.contentDocument)) {
    heading.style.borderInlineStart = wrong.has(heading.id) ? "4px solid #d1242f" : "";
    heading.style.paddingInlineStart = wrong.has(heading.id) ? ".5rem" : "";
  }
}

/* -- from the page to the sheet and back ----------------------------------------------------------------- */

/* The question, else the problem, in which a line stands. */
const sectionOf = (line) => view.sections.filter((each) => each.first <= line && line <= each.last).pop();

/* A click on a formula, a figure or a heading. */
function clicked(event) {
  const on = event.target.closest("math, .display, figure, table, h2, h3, h4");
  if (!on || !frame.contentWindow.getSelection().isCollapsed) return;
  const above = headings(frame.contentDocument)
    .filter((each) => each === on || each.compareDocumentPosition(on) & Node.DOCUMENT_POSITION_FOLLOWING)
    .pop();
  const section = above && view.sections.find((each) => each.id === above.id);
  if (section) toLines(section.first, section.last);
}

function toLines(first, last) {
  open("source", true);
  const lines = [...part("source").querySelectorAll("li")];
  lines.forEach((line, index) => line.classList.toggle("here", first <= index + 1 && index + 1 <= last));
  if (lines[first - 1]) lines[first - 1].scrollIntoView({ block: "center" });
}

function toSection(line) {
  const section = sectionOf(line);
  if (!section || !frame) return;
  const ids = [section.id, section.id.replace(/^question-(\d+)-\d+$/, "problem-$1")];  // one question has no heading
  const heading = ids.map((id) => frame.contentDocument.getElementById(id)).find(Boolean);
  if (heading) heading.scrollIntoView();
}

/* -- what is shown on demand ----------------------------------------------------------------------------- */

function open(id, wanted) {
  const place = frame && placeIn(frame.contentWindow);
  part(id).hidden = !wanted;
  if (place) goTo(frame.contentWindow, place);
  part(`show-${id}`).setAttribute("aria-expanded", wanted);
}

for (const id of ["source", "proved"]) part(`show-${id}`).onclick = () => open(id, part(id).hidden);
part("steps").onchange = (event) => {
  const chosen = event.target.value;
  fetch(chosen ? `steps/${chosen}` : "steps", { method: "POST" });
};
