# docker build -t risorius .
# docker run --rm --read-only --tmpfs /tmp -v "$PWD:/work" --user "$(id -u):$(id -g)" risorius speak "Hello!" -o hello.mp4
# The digests of requirements/run.txt are those of the files for CPython 3.11 on Linux with x86-64.
FROM --platform=linux/amd64 python:3.11-slim AS build
WORKDIR /src
COPY requirements/run.txt requirements/run.txt
RUN python -m venv /opt/risorius && /opt/risorius/bin/pip install --no-cache-dir --require-hashes -r requirements/run.txt
COPY pyproject.toml hatch_build.py README.md LICENSE LICENSE-CC0 ./
COPY src src
RUN /opt/risorius/bin/pip install --no-cache-dir --no-deps --no-build-isolation --no-index .
# numba has compiled the kernels, for x86-64 processors with AVX2; to run, it is not needed.
RUN /opt/risorius/bin/pip uninstall --yes numba
# Faces are solved once, for whatever user runs them later.
ENV RISORIUS_CACHE_DIR=/opt/risorius-cache OPENBLAS_NUM_THREADS=1
RUN /opt/risorius/bin/risorius pose AU12=1 --size 64x64 -o /tmp/warm.png \
 && /opt/risorius/bin/risorius speak "Warm." --size 64x64 --fps 4 -o /tmp/warm.mp4 \
 && chmod -R a+rX /opt/risorius-cache

FROM --platform=linux/amd64 python:3.11-slim
RUN useradd --create-home --uid 10001 risorius
COPY --from=build /opt/risorius /opt/risorius
COPY --from=build /opt/risorius-cache /opt/risorius-cache
ENV PATH=/opt/risorius/bin:$PATH RISORIUS_CACHE_DIR=/opt/risorius-cache OPENBLAS_NUM_THREADS=1
USER risorius
WORKDIR /work
ENTRYPOINT ["risorius"]
CMD ["--help"]
