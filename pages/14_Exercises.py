from ui.exercises import stage
from ui.frame.page import Stage, show

show(
    "Exercises",
    "Twelve exercises on the notes, with numbers of your own.",
    stage.content,
    stage=Stage(stage.arrive, stage.heading, stage.sidebar),
)
