// An ADS client in Node.js: it switches an axis on and moves it by methods of the axis object GVL_MOTION.Axis[1].
//
//   npm install
//   node client.mjs [host:port]

import { Client } from 'ads-client';

const [host, port] = (process.argv[2] ?? '127.0.0.1:48898').split(':');
const client = new Client({
  targetAmsNetId: '127.0.0.1.1.1',
  targetAdsPort: 851,
  routerAddress: host,
  routerTcpPort: Number(port ?? 48898),
});

const AXIS = 'GVL_MOTION.Axis[1]';
const DYNAMICS = { Velocity: 400, Acceleration: 0, Deceleration: 0, Jerk: 0, BufferMode: 'MC_Aborting' };

// Calls a method; resolves when the command that it gives has ended.
async function execute(method, inputs) {
  const { returnValue, outputs } = await client.invokeRpcMethod(AXIS, method, inputs);
  if (returnValue !== 0) throw new Error(`${method}: refused with 0x${returnValue.toString(16)}`);
  await ended(method, outputs.Command);
}

// Resolves when the axis object tells that a command has ended; it tells of the last one only.
function ended(method, command) {
  return new Promise((resolve, reject) => {
    const subscription = client.subscribeValue(AXIS, ({ value: axis }) => {
      if (axis.Command === command && axis.Busy) return;
      subscription.then((one) => one.unsubscribe()).then(() => {
        if (axis.Command === command && axis.Done) resolve();
        else reject(new Error(`${method}: ended with 0x${axis.ErrorID.toString(16)}, or another command took over`));
      });
    }, 10);
  });
}

// Resolves when a value is as wanted.
function until(path, wanted) {
  return new Promise((resolve) => {
    const subscription = client.subscribeValue(path, ({ value }) => {
      if ((value?.name ?? value) === wanted) subscription.then((one) => one.unsubscribe()).then(resolve);
    }, 10);
  });
}

await client.connect();
await until('MAIN_AXIS.eInit', 'PROGRESS_DONE');
const { value: axis } = await client.readValue(AXIS);
console.log('axis', axis.Name);

await client.invokeRpcMethod(AXIS, 'Power', { Enable: true, Enable_Positive: true, Enable_Negative: true });
await until('GVL_AXIS.Info[1].bEnabled', true);

for (const Position of [100, 250, 0]) {
  await execute('MoveAbsolute', { Position, ...DYNAMICS });
  const { value: info } = await client.readValue('GVL_AXIS.Info[1]');
  console.log('position', info.rActPos.toFixed(2));
}
await client.disconnect();
