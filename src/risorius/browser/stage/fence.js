const LOOK = 2; // ms after which it is looked again

/** Wait until all that was asked for is drawn. @param {any} gl of WebGL 2 */
export async function drawn(gl) {
  const fence = /** @type {WebGLSync} */ (gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0));
  gl.flush();
  do await new Promise((go) => setTimeout(go, LOOK));
  while (!gl.isContextLost() && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED);
  gl.deleteSync(fence);
}
