"""A lecture by the keys that a presenter's clicker sends, and a student's sheet."""

from playwright.sync_api import expect

from tests.browser.app_page import AppPage


def test_a_clicker_leads_on_after_a_slider_was_dragged(app: AppPage) -> None:
    app.open("Lecture", step="2")
    heading = app.page.get_by_test_id("stHeading").first
    expect(heading).to_have_text("2 · Where the journal sits")
    ends = app.page.locator(".live-slider span")
    assert ends.all_inner_texts() == ["500", "12000"]
    thumb = app.slider("Running speed").bounding_box()
    assert thumb
    app.page.mouse.move(thumb["x"] + thumb["width"] / 2, thumb["y"] + thumb["height"] / 2)
    app.page.mouse.down()
    app.page.mouse.move(thumb["x"] + 0.6 * thumb["width"], thumb["y"] + thumb["height"] / 2)
    app.page.mouse.up()
    app.rest()
    app.slider("Running speed").focus()
    app.page.keyboard.press("ArrowRight")  # which leaves the focus on the slider
    app.rest()
    app.page.keyboard.press("s")
    expect(app.page.get_by_text("To one side, along a curve")).to_be_visible()
    app.rest()
    assert ends.all_inner_texts() == ["500", "12000"]
    app.slider("Running speed").focus()
    app.page.keyboard.press("PageDown")
    expect(heading).to_have_text("3 · Why it moves sideways")


def test_a_faulty_formula_of_a_lecturers_own_file_is_said_to_be_faulty(app: AppPage) -> None:
    app.open("Lecture")
    steps = r"""
[[step]]
title = "One step"
say = 'Here $\foo^2$ and $\frac{a}{b$.'
view = "locus"
question = "Which?"
answer = "Both."
"""
    app.page.get_by_role("button", name="Steps from a file", exact=True).click()
    own = {"name": "own.toml", "mimeType": "text/plain", "buffer": steps.encode()}
    with app.run():
        app.page.get_by_test_id("stFileUploaderDropzoneInput").set_input_files(own)
    said = app.page.locator(".st-key-lecture_say")
    expect(said.locator(".katex-error")).to_be_visible()
    words = said.evaluate(
        """said => [...said.querySelectorAll('*')]
          .map(one => getComputedStyle(one, '::after').content)
          .filter(content => content.includes('('))"""
    )
    assert len(words) == 2
    assert "unknown command" in words[0]
    assert "this formula is faulty. ParseError" in words[1]


def test_on_a_phone_a_long_legend_leaves_a_steps_chart_its_plot(app: AppPage) -> None:
    app.page.set_viewport_size({"width": 390, "height": 844})
    app.open("Lecture", step="10")
    assert app.page.locator(".legendtext").count() == 4
    plot = app.page.locator(".js-plotly-plot .bglayer").first.bounding_box()
    assert plot
    assert plot["height"] > 260
    expect(app.page.locator(".modebar").first).to_be_hidden()


def test_a_sheet_has_the_students_own_number(app: AppPage) -> None:
    app.open("Exercises", exercise="3", seed="4711")
    with app.page.expect_download() as came:
        app.page.get_by_role("button", name="Sheet for print").click()
    sheet = came.value.path().read_text(encoding="utf-8")
    shown = app.page.get_by_text("A short bearing has the diameter").inner_text()
    assert "number 4711" in sheet
    assert shown.split("What are")[0].strip() in sheet


def test_an_address_in_lower_case_leads_to_the_page(app: AppPage) -> None:
    app.page.goto(f"{app.url}/lecture?step=4")
    expect(app.page.get_by_test_id("stHeading").first).to_have_text("4 · Stiffness")
    assert app.page.url.endswith("/Lecture?step=4")
