"""What every page has around its content: title, navigation, sidebar, and the cases."""
