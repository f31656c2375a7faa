// What the npm package ads-client makes of the server: node node_client.mjs host:port all|reconnect|restarts

import assert from 'node:assert/strict';
import { Client } from 'ads-client';

const [host, port] = process.argv[2].split(':');
const client = new Client({
  targetAmsNetId: '127.0.0.1.1.1',
  targetAdsPort: 851,
  routerAddress: host,
  routerTcpPort: Number(port),
  timeoutDelay: 60000,
  reconnectInterval: 200,
  convertDatesToJavascript: false,
  objectifyEnumerations: false,
  hideConsoleWarnings: true,
});

const WRITTEN = {
  bBool: true,
  nByte: 200,
  nSint: -100,
  nUsint: 255,
  nInt: -30000,
  nUint: 60000,
  nWord: 0xabcd,
  nDint: -(2 ** 31),
  nUdint: 2 ** 32 - 1,
  nDword: 0xdeadbeef,
  nLint: -(2n ** 63n),
  nUlint: 2n ** 64n - 1n,
  nLword: 2n ** 63n,
  rReal: 0.5,
  rLreal: 1e-300,
  tTime: 86400000,
  tLtime: 10n ** 15n,
  dDate: 1641600000,
  dDt: 1700000000,
  dTod: 43200000,
  sText: 'größer',
  wsText: 'Größe λ',
  eColour: 7,
  aNumbers: [1, -2, 3, -4],
  aGrid: [[1, 2, 3], [-4, -5, -6]],
  stInner: { bFlag: true, bOther: false, rValue: -2.5 },
};

// Resolves with the first value of a symbol that is wanted.
function watched(path, wanted) {
  return new Promise((resolve) => {
    const made = client.subscribeValue(path, ({ value }) => {
      if (wanted(value)) made.then((one) => one.unsubscribe()).then(() => resolve(value));
    }, 10);
  });
}

// ads-client 2.1 counts the size of an element once for each dimension of an array, and sends too much: not this one.
async function writeGrid(rows) {
  for (const [i, row] of rows.entries())
    for (const [j, value] of row.entries()) await client.writeValue(`GVL.All.aGrid[${i},${j + 1}]`, value);
}

async function everyTypeAlone() {
  for (const [name, value] of Object.entries(WRITTEN)) {
    await (name === 'aGrid' ? writeGrid(value) : client.writeValue(`GVL.All.${name}`, value));
    assert.deepEqual((await client.readValue(`GVL.All.${name}`)).value, value, name);
  }
}

async function everyTypeInOneStructure() {
  const changed = { ...WRITTEN, nInt: 17, sText: 'other', stInner: { bFlag: false, bOther: true, rValue: 4.5 } };
  await client.writeValue('GVL.All', changed);
  assert.deepEqual((await client.readValue('GVL.All')).value, changed);
  assert.equal((await client.readValue('GVL.Inners[1].bOther')).value, false);
  await client.writeValue('GVL.Inners[1].bOther', true);
  assert.deepEqual((await client.readValue('GVL.Inners')).value[0], { bFlag: false, bOther: true, rValue: 0 });
}

async function tree() {
  const symbols = Object.values(await client.getSymbols()).map((one) => one.name);
  for (const name of ['GVL.All', 'GVL.Count', 'GVL_AXIS.Ctrl', 'GVL_MOTION.Axis']) assert(symbols.includes(name), name);
  assert(Object.keys(await client.getDataTypes()).length > 20);
  const all = await client.getDataType('ST_EVERYTHING');
  assert.deepEqual(all.subItems.map((one) => one.name), Object.keys(WRITTEN));
}

async function handlesAndSums() {
  const handle = await client.createVariableHandle('GVL.Count');
  await client.writeRawByHandle(handle, Buffer.from([5, 0, 0, 0]));
  assert.deepEqual(await client.readRawByHandle(handle), Buffer.from([5, 0, 0, 0]));
  await client.deleteVariableHandle(handle);
  await assert.rejects(client.readRawByHandle(handle));
  const { indexGroup, indexOffset } = await client.getSymbol('GVL.Count');
  const one = { indexGroup, indexOffset, size: 4 };
  const read = await client.readRawMulti([one, { ...one, indexGroup: 0xdead }]);
  assert.deepEqual(read.map((part) => part.success), [true, false]);
}

async function notifications() {
  const seen = watched('GVL.Count', (value) => value === 42);
  await client.writeValue('GVL.Count', 42);
  assert.equal(await seen, 42);
}

async function errors() {
  await assert.rejects(client.writeValue('GVL.Shown[1]', 1.0));
  await assert.rejects(client.readValue('GVL.Nothing'));
}

// shown: methods
async function methods() {
  const axis = 'GVL_MOTION.Axis[1]';
  const refused = await client.invokeRpcMethod(axis, 'Halt', { Deceleration: 0, Jerk: 0, BufferMode: 1 });
  assert.notEqual(refused.returnValue, 0);
  const on = { Enable: true, Enable_Positive: true, Enable_Negative: true };
  assert.equal((await client.invokeRpcMethod(axis, 'Power', on)).returnValue, 0);
  await watched('GVL_AXIS.Info[1].bEnabled', (value) => value);
  const move = { Position: 20, Velocity: 300, Acceleration: 0, Deceleration: 0, Jerk: 0, BufferMode: 'MC_Aborting' };
  const { returnValue, outputs } = await client.invokeRpcMethod(axis, 'MoveAbsolute', move);
  assert.equal(returnValue, 0);
  const shown = await watched(axis, (value) => value.Command === outputs.Command && !value.Busy);
  assert.equal(shown.Done, true);
}
// end

// Goes on with its notification when the server has been away.
async function reconnect() {
  let told;
  const again = new Promise((resolve) => { told = resolve; });
  await client.subscribeValue('GVL.Count', ({ value }) => { if (value === 2) told(); }, 10);
  const back = new Promise((resolve) => { client.on('reconnect', resolve); });
  await client.writeValue('GVL.Count', 1);
  assert.equal(await back, true);
  await client.writeValue('GVL.Count', 2);
  await again;
}

// Restarts the run, by the port of the PLC and by that of the system; notifications go on.
async function restarts() {
  const seen = new Set();
  await client.subscribeValue('GVL.Count', ({ value }) => seen.add(value), 10);
  const told = async (value) => {
    await client.writeValue('GVL.Count', value);
    while (!seen.has(value)) await client.readValue('GVL.Count');
  };
  await told(1);
  const version = new Promise((resolve) => { client.once('plcSymbolVersionChange', resolve); });
  await client.restartPlc();
  await version;
  assert.equal((await client.readValue('GVL.Count')).value, 0);
  await told(2);
  const back = new Promise((resolve) => { client.once('reconnect', resolve); });
  await client.setTcSystemToRun();
  assert.equal(await back, true);
  await told(3);
}

const PARTS = {
  all: [tree, everyTypeAlone, everyTypeInOneStructure, handlesAndSums, notifications, errors, methods],
  reconnect: [reconnect],
  restarts: [restarts],
};

await client.connect();
for (const part of PARTS[process.argv[3]]) {
  await part();
  console.log(part.name);
}
await client.disconnect();
