"""What every page has around its content: title, navigation, sidebar, the pinned machine."""
