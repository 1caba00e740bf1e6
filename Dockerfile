# The service in one image; its steps are those of make, so that a container is set up like any other machine.
# docker-compose.yml runs it; docs/running.md tells how.
FROM node:22-bookworm-slim
WORKDIR /app
RUN apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq make python3

# What changes rarely comes first, so that a change of the code does not install everything again.
COPY Makefile requirements.lock ./
COPY .ci .ci
RUN make .make/python

COPY web/package.json web/package-lock.json web/
COPY web/client-generator/package.json web/client-generator/
RUN make web/node_modules/.package-lock.json

COPY . .
RUN make setup

# The volume that is mounted here takes over that everybody may write.
RUN mkdir -m 0777 /data
ENV PATH=/app/.venv/bin:$PATH SLDR_HOME=/data
USER node
EXPOSE 8000
CMD ["sldr", "serve", "--host", "0.0.0.0"]
