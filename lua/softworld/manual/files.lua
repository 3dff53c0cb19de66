-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
what is written       appears whole or not at all; what a killed run left is removed by the next one
                      that writes into the folder; saved scenes are on the disk before the old file goes.
                      Paths may have any characters. Devices and pipes are written to in place.
what is read          must be a file: pipes and devices may never end (/dev/stdin is allowed)
numbers               have a decimal point, whatever os.setlocale says; it still works for all else
mesh files            .stl .obj .ply .off .glb .gltf are read in a process of their own, with limits:
                      memory 256 MB + 150 bytes for each of the file's, 4 s + 1 s for each MB of computing.
                      What a file declares is compared with its length first: one that was cut off is
                      refused. obj and gltf declare nothing, so that a cut off obj may be read in part.]]
