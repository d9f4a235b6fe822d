from ui.frame.page import Stage, show
from ui.lecture import stage

show(
    "Lecture",
    "The notes in thirteen steps.",
    stage.content,
    stage=Stage(stage.arrive, stage.heading, stage.sidebar, is_whole=True),
)
