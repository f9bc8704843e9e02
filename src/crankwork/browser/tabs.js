// Tabs, of which one panel is seen at a time, and menus that close by themselves.

/**
 * Let tabs show their panels, by pointer and by arrow keys; return what shows a panel.
 * @param {Element | null} list
 */
export function bindTabs(list) {
  const tabs = /** @type {HTMLElement[]} */ ([...(list?.children ?? [])]);
  const show = (/** @type {string | null} */ id) => {
    for (const tab of tabs) {
      const own = tab.getAttribute("aria-controls") ?? "";
      tab.ariaSelected = String(own === id);
      tab.tabIndex = own === id ? 0 : -1;
      const panel = document.getElementById(own);
      if (panel) panel.hidden = own !== id;
    }
  };
  for (const [k, tab] of tabs.entries()) {
    tab.addEventListener("click", () => show(tab.getAttribute("aria-controls")));
    tab.addEventListener("keydown", ({ key }) => {
      const next = tabs[(k + Number(key === "ArrowRight") - Number(key === "ArrowLeft") + tabs.length) % tabs.length];
      if (next === tab) return;
      next.focus();
      next.click();
    });
  }
  tabs[0]?.click();
  return show;
}

/** Close a menu where something else is pressed, or what it offers is taken, or Escape. */
export function bindMenus() {
  const close = (/** @type {Event} */ event) => {
    const target = /** @type {Element} */ (event.target);
    const menu = document.querySelector("details.menu[open]");
    if (menu && (event instanceof KeyboardEvent ? event.key === "Escape" : event.type === "change" || !target.closest(".menu summary, .menu select"))) menu.removeAttribute("open");
  };
  for (const kind of ["click", "change", "keydown"]) document.addEventListener(kind, close);
}
