"""The command line: thin, and the one place where errors become text and exit codes.

`group` is `derive` itself; each file beside it has commands, which need nothing heavy before they run.
"""

from derive.cli.building import build
from derive.cli.checking import check
from derive.cli.exchanging import export, import_
from derive.cli.group import main as main
from derive.cli.telling import kinds, new, schema
from derive.cli.watching import watch

for command in (build, check, kinds, new, import_, export, schema, watch):
    main.add_command(command)
