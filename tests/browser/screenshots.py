"""Take the README's screenshots, docs/*.png: python -m tests.browser.screenshots ADDRESS.

ADDRESS is that of a running app, such as http://127.0.0.1:8501.
"""

import os
import shutil
import sys
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, sync_playwright

from tests.browser.app_page import PATHS, AppPage

DOCS = Path(__file__).resolve().parents[2] / "docs"
SIZE = {"width": 1440, "height": 900}
ARGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
# The machine that shows a page best, where that is not the usual one.
QUERIES = {
    "Heat": {"T_in": "45", "flow": "12"},
    "Tolerances": {"rpm": "8700", "spreads": "C~uniform~51~69~~load~triangular~1200~1334~1400"},
    "Criteria": {"preset": "sheet-1e7", "slowest": "3000", "coupling": "given", "qa": "0.8"},
}


def main(address: str) -> None:
    """Save one picture of each page."""
    DOCS.mkdir(exist_ok=True)
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=ARGS)
        for name in PATHS:
            _take(browser, address, name)
        browser.close()


def _take(browser: Browser, address: str, name: str) -> None:
    tab = AppPage(browser.new_page(viewport=SIZE), address)
    tab.open(name, **QUERIES.get(name, {}))
    path = DOCS / f"{(PATHS[name] or 'home').lower()}.png"
    tab.page.screenshot(path=path)
    tab.page.close()
    with Image.open(path) as picture:
        picture.convert("RGB").save(path, optimize=True)
    print(f"{path.name}: {path.stat().st_size / 1000:.0f} kB")  # noqa: T201


if __name__ == "__main__":
    main(sys.argv[1])
