-- SPDX-License-Identifier: GPL-3.0-or-later
std = "lua54"
max_line_length = 110
files["spec"] = { std = "+busted" }
