"""What a problem gives, as its page prints it: one room a subject, and one for what stands beside `find`.

A room gives `data(subject, problem)`: records of phrases, tables and equations, with no English in them.
Their words stand in `templates/words/<subject>/_given.j2`. What the text of a problem says by itself is left
out by `derive.render.mentioned`, and what a question asks for by the room. Begin with `datum`, then `robot`.
"""
