-- SPDX-License-Identifier: GPL-3.0-or-later
-- A Slurm of one machine in a temporary folder, for specs: munged with its own key, slurmctld and slurmd on
-- free ports, run by the user who runs the specs. It needs no root, no cgroups and nothing of /etc.
local program = require "host.program"
local socket = require "socket"

local cluster = {}

local DAEMONS = { "slurmd", "slurmctld", "munged" } -- in the order in which they are stopped

local CONF = [[
ClusterName=softworld
SlurmctldHost=HOST(127.0.0.1)
SlurmctldPort=PORT1
SlurmdPort=PORT2
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=DIR/munge.sock,cred_expire=5
SlurmUser=USER
SlurmdUser=USER
StateSaveLocation=DIR/state
SlurmdSpoolDir=DIR/spool
SlurmctldPidFile=DIR/slurmctld.pid
SlurmdPidFile=DIR/slurmd.pid
SlurmctldLogFile=DIR/slurmctld.log
SlurmdLogFile=DIR/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
MaxArraySize=11
KillWait=1
NodeName=HOST NodeAddr=127.0.0.1 CPUs=16 State=UNKNOWN
PartitionName=main Nodes=HOST Default=YES State=UP
]]

local function line_of(command)
  local out, err, code = program.shell(command)
  assert(code == 0, command .. ": " .. err)
  return out:match "[^\n]+"
end

local function free_port()
  local s = assert(socket.bind("127.0.0.1", 0))
  local _, port = s:getsockname()
  s:close()
  return math.tointeger(port)
end

-- The output of the daemons, for the message when they could not be started.
local function words(folder)
  local texts = {}
  for _, name in ipairs(DAEMONS) do
    local out = program.shell(("tail -n 8 %s/%s.log 2>&1"):format(folder, name))
    texts[#texts + 1] = name .. ":\n" .. out
  end
  return table.concat(texts)
end

-- Stops the daemons when this process has ended without stopping them.
local GUARD = [[
(while kill -0 PID 2>/dev/null && [ -d DIR ]; do sleep 1; done
 [ -d DIR ] && SLURM_CONF=DIR/slurm.conf timeout 10 scancel --me && sleep 2
 for f in slurmd slurmctld munged; do kill -KILL $(cat DIR/$f.pid) 2>/dev/null; done; rm -rf DIR
) >/dev/null 2>&1 </dev/null &]]

local function pid_of(folder, name)
  local out = program.shell(("cat %s/%s.pid 2>/dev/null"):format(folder, name))
  return math.tointeger(out:match "%d+")
end

local function start(self)
  local folder = self.folder
  local host, user = line_of "hostname -s", line_of "id -un"
  program.write(folder .. "/slurm.conf", (CONF:gsub("%u+%d?", { HOST = host, USER = user, DIR = folder,
    PORT1 = free_port(), PORT2 = free_port() })))
  line_of(("mkdir %s/state %s/spool && head -c 1024 /dev/urandom >%s/munge.key && chmod 400 %s/munge.key "
    .. "&& echo x"):format(folder, folder, folder, folder))
  os.execute((GUARD:gsub("PID", line_of "echo $PPID"):gsub("DIR", folder)))
  for _, command in ipairs {
    ("munged --force --key-file=%s/munge.key --socket=%s/munge.sock --pid-file=%s/munged.pid "
      .. "--seed-file=%s/munge.seed --log-file=%s/munged.log --num-threads=1"):gsub("%%s", folder),
    ("slurmctld -f %s/slurm.conf"):format(folder), ("slurmd -f %s/slurm.conf"):format(folder) } do
    local out, err, code = program.shell("PATH=$PATH:/usr/sbin:/sbin; " .. command)
    if code ~= 0 then error(("%s: %s%s\n%s"):format(command, out, err, words(folder)), 0) end
  end
  for _ = 1, 300 do
    if program.shell(self.env .. " sinfo -h -o %T"):find "idle" then return end
    socket.sleep(0.1)
  end
  error("Slurm does not come up:\n" .. words(folder), 0)
end

--- Starts a cluster, or raises an error with the daemons' output. Returns { env = prefix of a command, folder
-- = }.
function cluster.start()
  local folder = line_of "mktemp -d /tmp/softworld-slurm.XXXXXX"
  local self = setmetatable({ folder = folder }, { __index = cluster })
  self.env = ("env SLURM_CONF=%s/slurm.conf"):format(self.folder)
  local fine, why = pcall(start, self)
  if fine then return self end
  self:stop()
  error("Slurm cannot be started here (packages slurmctld slurmd slurm-client munge of scripts/setup.sh): "
    .. tostring(why), 0)
end

--- Calls ends() until it returns a value that is true, which it returns, or 0.05 s as often as told.
function cluster.waited(ends, times)
  for _ = 1, times do
    local found = ends()
    if found then return found end
    socket.sleep(0.05)
  end
end

--- Runs a command of Slurm; returns its output.
function cluster:ask(command)
  local out, err = program.shell(self.env .. " " .. command)
  return out .. err
end

--- Stops all daemons.
function cluster:stop()
  program.shell(self.env .. " timeout 10 scancel --me")
  for _ = 1, 50 do
    if program.shell(self.env .. " timeout 10 squeue -h") == "" then break end
    socket.sleep(0.1)
  end
  local pids = {}
  for _, name in ipairs(DAEMONS) do pids[name] = pid_of(self.folder, name) end
  local function signal(which)
    local count = 0
    for name, pid in pairs(pids) do
      if program.shell(("cat /proc/%d/comm 2>/dev/null"):format(pid)) == name .. "\n"
        and not program.shell(("cat /proc/%d/status"):format(pid)):find "State:%s*Z" then
        program.shell(("kill -%s %d"):format(which, pid))
        count = count + 1
      end
    end
    return count
  end
  signal "TERM"
  for _ = 1, 50 do
    if signal "CONT" == 0 then break end
    socket.sleep(0.1)
  end
  signal "KILL"
  program.shell("rm -rf " .. self.folder)
end

return cluster
