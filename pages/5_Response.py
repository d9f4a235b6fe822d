from ui import page as frame
page = frame.begin("X", "test")
