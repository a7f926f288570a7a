"""What tools/reproduce-paper is made of: the runs, their numbers with errors, pictures, words, and the
report's pages."""
