// What the npm package ads-client says, to be recorded: node node.mjs port

import { Client } from 'ads-client';

const client = new Client({
  targetAmsNetId: '127.0.0.1.1.1',
  targetAdsPort: 851,
  routerAddress: '127.0.0.1',
  routerTcpPort: Number(process.argv[2]),
  timeoutDelay: 60000,
  hideConsoleWarnings: true,
});

await client.connect();
await client.readState();
await client.readDeviceInfo();
await client.getSymbols();
await client.writeValue('GVL.Count', 77);
await client.readValue('GVL.Count');
await client.readValue('GVL.All');
await client.writeValue('GVL.All.sText', 'text');
await client.writeValue('GVL.Inners[2]', { bFlag: true, bOther: false, rValue: 1.5 });
await client.writeValue('GVL.Inners[2].bOther', true);
await client.readValue('GVL.Inners');
await client.readRawByPath('GVL.Shown[1]');
const handle = await client.createVariableHandle('GVL.Count');
await client.writeRawByHandle(handle, Buffer.from([5, 0, 0, 0]));
await client.readRawByHandle(handle);
await client.deleteVariableHandle(handle);
const { indexGroup, indexOffset } = await client.getSymbol('GVL.Count');
const one = { indexGroup, indexOffset, size: 4 };
await client.writeRawMulti([{ ...one, value: Buffer.from([6, 0, 0, 0]) }]);
await client.readRawMulti([one, { ...one, indexGroup: 0xdead }]);
const handles = await client.createVariableHandleMulti(['GVL.Count', 'GVL.Nothing']);
await client.deleteVariableHandleMulti(handles.filter((made) => made.success).map((made) => made.handle));
const watched = await client.subscribeValue('GVL.Count', () => {}, 10);
for (let i = 0; i < 5; i++) await client.writeValue('GVL.Count', i);
await watched.unsubscribe();
await client.readValue('GVL.Nothing').catch(() => {});
await client.writeValue('GVL.Shown[1]', 1).catch(() => {});
await client.writeControl({ adsState: 'Stop', deviceState: 0 }).catch(() => {});
await client.disconnect();
